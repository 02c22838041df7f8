// names.hpp: the words of scene files for the options of a run, one table each, for reader and writer alike.
// `built` can be chosen; `known` is named in the documentation but not built yet and is refused by name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/scene.hpp"

namespace wedge {

template <class E>
struct Names {
  std::vector<std::pair<std::string, E>> built;
  std::vector<std::string> known;

  std::string of(E value) const {
    for (const auto& [word, meaning] : built)
      if (meaning == value) return word;
    return "";
  }
  std::vector<std::string> words() const {
    std::vector<std::string> all;
    for (const auto& entry : built) all.push_back(entry.first);
    return all;
  }
  /// The words whose meaning is of a kind, as in "line" or "hollow".
  template <class IsOfKind>
  std::string choice_of(IsOfKind&& is_of_kind) const {
    std::string text;
    for (const auto& [word, meaning] : built)
      if (is_of_kind(meaning)) text += (text.empty() ? "\"" : " or \"") + word + '"';
    return text;
  }
};

inline const Names<DomainKind> domain_kind_names{
    {{"full", DomainKind::full}, {"sector", DomainKind::sector}, {"slot", DomainKind::slot}}, {"graded"}};
inline const Names<Sides> sides_names{
    {{"periodic", Sides::periodic}, {"rigid", Sides::rigid}, {"frictionless", Sides::frictionless}}, {}};
inline const Names<AxisRule> axis_names{{{"clamp", AxisRule::clamp},
                                         {"images", AxisRule::images},
                                         {"pin", AxisRule::pin},
                                         {"line", AxisRule::line},
                                         {"hollow", AxisRule::hollow}},
                                        {}};
inline const Names<ContactLaw> law_names = [] {
  Names<ContactLaw> names;
  for_each_law([&](const auto& entry) { names.built.emplace_back(entry.name, entry.law); });
  return names;
}();
inline const Names<RollingModel> rolling_names{{{"none", RollingModel::none},
                                                {"constant_torque", RollingModel::constant_torque},
                                                {"elastic_plastic_spring", RollingModel::elastic_plastic_spring}},
                                               {}};
inline const Names<Tension> tension_names{{{"full", Tension::full}, {"none", Tension::none}}, {}};
inline const Names<RollingVelocity> rolling_velocity_names{
    {{"own", RollingVelocity::own}, {"relative", RollingVelocity::relative}}, {}};
inline const Names<Coulomb> coulomb_names{{{"printed", Coulomb::printed}, {"total", Coulomb::total}}, {}};
inline const Names<Precision> precision_names{
    {{"double", Precision::double_precision}, {"mixed", Precision::mixed}}, {}};
inline const Names<FramePrecision> frame_precision_names{
    {{"single", FramePrecision::single_precision}, {"double", FramePrecision::double_precision}}, {}};

}  // namespace wedge
