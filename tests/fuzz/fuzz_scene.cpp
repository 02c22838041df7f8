// fuzz_scene.cpp: any text as a scene file.
#include <stdexcept>

#include "core/require.hpp"
#include "io/scene/scene_file.hpp"
#include "tests/fuzz/fuzz_readers.hpp"

namespace wedge::fuzz {

void scene(const std::string& bytes) {
  std::string resolved;
  try {
    const Scene read = parse_scene(bytes, "scene.toml", {}, "/folder");
    resolved = resolved_scene(read);
    (void)scene_warnings(read);
  } catch (const SceneError&) {
    return;
  }
  const std::string again = resolved_scene(parse_scene(resolved, "scene.resolved.toml", {}, "/folder"));
  if (again != resolved) throw std::logic_error("a resolved scene does not read back to itself:\n" + resolved);
}

}  // namespace wedge::fuzz
