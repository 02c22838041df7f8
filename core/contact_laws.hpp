// contact_laws.hpp: the contact laws by name, and what tells one from another outside the loops.
//
// A new law: its entry here (three lines), its class SomeLaw in kernels/laws/some_law.hpp, and its test. CMake
// reads the entries and makes the files that compile the passes.
#pragma once

#include <tuple>

namespace wedge {

enum class ContactLaw { mindlin_deresiewicz, hertz_mindlin, linear };

// The classes of kernels/laws.
struct MindlinDeresiewicz;
struct HertzMindlin;
struct LinearLaw;

/// How the normal force grows with the overlap: to the power 3/2, or in proportion.
enum class NormalForce { hertzian, linear };
/// What a contact's stiffness follows from: the elastic constants of the two materials, or what [contact] says
/// (stiffness or contact_time).
enum class StiffnessFrom { materials, scene };

struct LawTraits {
  NormalForce normal;
  StiffnessFrom stiffness;
};

template <class Class>
struct LawEntry {
  using Law = Class;
  ContactLaw law;
  const char* name;  // as scenes write it
  LawTraits traits;
};

inline constexpr std::tuple contact_laws{
    LawEntry<MindlinDeresiewicz>{
        ContactLaw::mindlin_deresiewicz, "mindlin_deresiewicz", {NormalForce::hertzian, StiffnessFrom::materials}},
    LawEntry<HertzMindlin>{
        ContactLaw::hertz_mindlin, "hertz_mindlin", {NormalForce::hertzian, StiffnessFrom::materials}},
    LawEntry<LinearLaw>{ContactLaw::linear, "linear", {NormalForce::linear, StiffnessFrom::scene}}};

/// Calls visit(entry) for every law.
template <class Visit>
constexpr void for_each_law(Visit&& visit) {
  std::apply([&](const auto&... entry) { (visit(entry), ...); }, contact_laws);
}

constexpr LawTraits traits_of(ContactLaw law) {
  LawTraits traits{};
  for_each_law([&](const auto& entry) {
    if (entry.law == law) traits = entry.traits;
  });
  return traits;
}
constexpr bool is_hertzian(ContactLaw law) { return traits_of(law).normal == NormalForce::hertzian; }
constexpr bool stiffness_is_given(ContactLaw law) { return traits_of(law).stiffness == StiffnessFrom::scene; }

}  // namespace wedge
