// passes_hertz_mindlin.cpp: the passes compiled for the law HertzMindlin.
#include "kernels/law_passes_impl.hpp"
#include "kernels/laws/hertz_mindlin.hpp"

namespace wedge {
template LawPasses make_law_passes<HertzMindlin>(const Scene&, const State&, Friction, bool);
template LawPasses make_law_passes<TotalCoulomb<HertzMindlin>>(const Scene&, const State&, Friction, bool);
}  // namespace wedge
