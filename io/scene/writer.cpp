// writer.cpp: a Scene as TOML text, every default written out.
#include <string>

#include "io/scene/diagnostics.hpp"
#include "io/scene/names.hpp"
#include "io/scene/scene_file.hpp"

namespace wedge {

namespace {

/// A TOML float: shortest digits that read back to the same double, and never an integer.
std::string number(double value) {
  const std::string text = plain_number(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string quoted(const std::string& text) {
  const char* const hex = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      out += std::string("\\u00") + hex[byte >> 4] + hex[byte & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

/// A piece of a table header: bare where TOML allows it.
std::string key_text(const std::string& name) {
  const char* const bare = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !name.empty() && name.find_first_not_of(bare) == std::string::npos ? name : quoted(name);
}

std::string or_auto(double value) { return value > 0 ? number(value) : "\"auto\""; }
std::string boolean(bool value) { return value ? "true" : "false"; }

template <class List, class Write>
std::string list(const List& values, Write&& write) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ", ") + write(value);
  return "[" + text + "]";
}

/// Collects lines of the form key = value under table headers.
class Writer {
public:
  void table(const std::string& header) { text_ += (text_.empty() ? "" : "\n") + header + "\n"; }
  void line(const std::string& key, const std::string& value) { text_ += key + " = " + value + "\n"; }
  const std::string& text() const { return text_; }

private:
  std::string text_;
};

void write_domain(Writer& w, const Scene& scene) {
  const Domain& domain = scene.domain;
  w.table("[domain]");
  w.line("kind", quoted(domain_kind_names.of(domain.kind)));
  if (domain.kind == DomainKind::slot)
    w.line("width", number(domain.slot_width));
  else
    w.line("angle", number(360.0 / domain.order));
  w.line("sides", quoted(sides_names.of(domain.sides)));
  w.line("axis", quoted(axis_names.of(domain.axis)));
  if (is_cylinder(domain.axis)) w.line("inner_radius", number(domain.inner_radius));
  if (is_solid(domain.axis))
    w.line("axis_material", quoted(scene.materials[static_cast<std::size_t>(domain.axis_material)].name));
  w.line("gravity", "[" + number(domain.gravity.x()) + ", " + number(domain.gravity.y()) + ", " +
                        number(domain.gravity.z()) + "]");
  if (domain.outlet_height) w.line("outlet", "{ z = " + number(*domain.outlet_height) + " }");
}

void write_walls(Writer& w, const Scene& scene) {
  for (const WallDescription& wall : scene.walls) {
    w.table("[[wall]]");
    w.line("name", quoted(wall.name));
    w.line("profile", list(wall.profile, [](const Eigen::Vector2d& p) {
             return "[" + number(p.x()) + ", " + number(p.y()) + "]";
           }));
    w.line("material", quoted(scene.materials[static_cast<std::size_t>(wall.material)].name));
    w.line("spin", number(wall.spin));
    w.line("speed", number(wall.speed));
    w.line("present", boolean(wall.present));
  }
}

void write_contact(Writer& w, const Scene& scene) {
  for (const Material& m : scene.materials) {
    if (is_rigid(m)) continue;
    w.table("[material." + key_text(m.name) + "]");
    w.line("density", number(m.density));
    w.line("young", number(m.young));
    w.line("poisson", number(m.poisson));
  }
  const ContactModel& contact = scene.contact;
  w.table("[contact]");
  w.line("law", quoted(law_names.of(contact.law)));
  w.line("rolling", quoted(rolling_names.of(contact.rolling)));
  if (contact.rolling == RollingModel::constant_torque)
    w.line("rolling_velocity", quoted(rolling_velocity_names.of(contact.rolling_velocity)));
  if (contact.rolling == RollingModel::elastic_plastic_spring)
    w.line("rolling_damping", number(contact.rolling_damping));
  w.line("tension", quoted(tension_names.of(contact.tension)));
  w.line("coulomb", quoted(coulomb_names.of(contact.coulomb)));
  if (stiffness_is_given(contact.law)) {
    if (contact.normal_stiffness > 0) w.line("stiffness", number(contact.normal_stiffness));
    if (contact.contact_time > 0) w.line("contact_time", number(contact.contact_time));
    w.line("tangential_ratio", number(contact.tangential_ratio));
  }
  for (int a = 0; a < scene.interactions.kinds(); ++a) {
    for (int b = a; b < scene.interactions.kinds(); ++b) {
      const Interaction& pair = scene.interactions(a, b);
      if (!pair.given) continue;
      w.table("[contact." +
              quoted(scene.materials[static_cast<std::size_t>(a)].name + "-" +
                     scene.materials[static_cast<std::size_t>(b)].name) +
              "]");
      w.line("sliding", number(pair.sliding));
      w.line("rolling", number(pair.rolling));
      if (pair.restitution)
        w.line("restitution", number(*pair.restitution));
      else
        w.line("damping", "[" + number(pair.damping_normal) + ", " + number(pair.damping_tangential) + "]");
    }
  }
}

void write_sizes(Writer& w, const Scene& scene, const RandomFill& fill) {
  const auto material = [&](int m) { return quoted(scene.materials[static_cast<std::size_t>(m)].name); };
  const auto* classes = std::get_if<std::vector<SizeClass>>(&fill.sizes);
  if (classes && classes->size() == 1) {
    w.line("diameter", number(classes->front().diameter));
    w.line("material", material(classes->front().material));
  } else if (classes) {
    w.line("sizes", list(*classes, [&](const SizeClass& c) {
             return "{ diameter = " + number(c.diameter) + ", fraction = " + number(c.fraction) +
                    ", material = " + material(c.material) + " }";
           }));
  } else if (const auto* uniform = std::get_if<UniformSizes>(&fill.sizes)) {
    w.line("diameter", "{ uniform = [" + number(uniform->smallest) + ", " + number(uniform->largest) + "] }");
    w.line("material", material(uniform->material));
  } else {
    const auto& s = std::get<LognormalSizes>(fill.sizes);
    w.line("diameter", "{ lognormal = { median = " + number(s.median) + ", sigma = " + number(s.sigma) +
                           ", smallest = " + number(s.smallest) + ", largest = " + number(s.largest) + " } }");
    w.line("material", material(s.material));
  }
}

void write_particles(Writer& w, const Scene& scene) {
  w.table("[particles]");
  if (const auto* file = std::get_if<StateFile>(&scene.particles.grains)) {
    w.line("file", quoted(file->path));
    if (file->diameter > 0) w.line("diameter", number(file->diameter));
    w.line("material", quoted(scene.materials[static_cast<std::size_t>(file->material)].name));
  } else {
    const RandomFill& fill = std::get<RandomFill>(scene.particles.grains);
    write_sizes(w, scene, fill);
    w.line("count", std::to_string(fill.count));
    const std::string across = scene.domain.kind == DomainKind::slot ? "x" : "r";
    w.line("region", "{ " + across + " = [" + number(fill.r_low) + ", " + number(fill.r_high) + "], z = [" +
                         number(fill.z_low) + ", " + number(fill.z_high) + "] }");
    w.line("speed", number(fill.speed));
  }
  w.line("seed", std::to_string(scene.particles.seed));
}

std::string until_text(const Stage& stage) {
  if (const auto* time = std::get_if<UntilTime>(&stage.until)) return number(time->duration);
  if (const auto* out = std::get_if<UntilDischarged>(&stage.until))
    return "{ discharged = " + std::to_string(out->count) + " }";
  return std::holds_alternative<UntilAtRest>(stage.until) ? "\"at rest\"" : "\"empty\"";
}

void write_stages(Writer& w, const Scene& scene) {
  for (const Stage& stage : scene.stages) {
    w.table("[[stage]]");
    w.line("name", quoted(stage.name));
    w.line("remove", list(stage.remove, quoted));
    w.line("add", list(stage.add, quoted));
    w.line("until", until_text(stage));
    w.line("at_most", number(stage.at_most));
    if (stage.time_step) w.line("time_step", number(*stage.time_step));
  }
}

void write_settings(Writer& w, const Scene& scene) {
  w.table("[rest]");
  w.line("speed", or_auto(scene.rest.speed));
  w.line("duration", or_auto(scene.rest.duration));
  w.table("[time]");
  w.line("step", or_auto(scene.time_step));
  const Output& output = scene.output;
  w.table("[output]");
  w.line("frames", number(output.frames_every));
  w.line("contacts", boolean(output.contacts));
  w.line("at", list(output.frames_at, number));
  w.line("precision", quoted(frame_precision_names.of(output.precision)));
  w.line("series", or_auto(output.series_every));
  w.line("checkpoints", number(output.checkpoint_every));
  w.line("energy_budget", boolean(output.energy_budget));
  w.table("[start]");
  w.line("from", quoted(scene.start_from));
  w.table("[run]");
  w.line("precision", quoted(precision_names.of(scene.run.precision)));
  w.line("skin", or_auto(scene.run.skin));
  w.line("threads", std::to_string(scene.run.threads));
}

}  // namespace

std::string resolved_scene(const Scene& scene) {
  Writer w;
  write_domain(w, scene);
  write_walls(w, scene);
  write_contact(w, scene);
  write_particles(w, scene);
  write_stages(w, scene);
  write_settings(w, scene);
  return w.text();
}

}  // namespace wedge
