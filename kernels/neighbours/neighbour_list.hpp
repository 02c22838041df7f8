// neighbour_list.hpp: the neighbour list: who may touch whom until somebody has moved too far.
#pragma once

#include <optional>
#include <vector>

#include "core/state.hpp"
#include "kernels/neighbours/neighbours.hpp"
#include "kernels/neighbours/reaction_map.hpp"

namespace wedge {

/// A grain to be put in.
struct NewGrain {
  Vec3 position, velocity, angular_velocity;  // m, m/s, rad/s
  double radius = 0;                          // m
  double mass = 0;                            // kg
  std::int32_t material = 0;
  std::int32_t layer = 0;
  std::optional<std::int32_t> id = std::nullopt;  // not given: the next one that no grain has had
};

/// Makes the contact tables of a state, which hold the near pairs and their histories, and keeps what it takes to
/// make them: the rules of pairs, working memory, and the map of reactions. Grains come and go through it, so that
/// slots, images, rows and counts have one home.
class NeighbourList {
public:
  /// `smallest_margin` [m] bounds from below how far a grain may go before the list is stale.
  NeighbourList(const PairRules& rules, double smallest_margin)
      : rules_(rules), smallest_margin_(smallest_margin) {}

  /// The first list of a state whose grains have places and velocities. Pre: dt > 0 [s]. Throws PhysicsError.
  void start(State& state, double dt);
  /// Makes the list anew: grains that left through a face are turned home and sorted, those that were removed drop
  /// out, histories follow their contacts. Pre: dt > 0 [s], the step to come. Throws PhysicsError.
  void renew(State& state, double dt);
  /// Moves images with their grains, for a list that still holds.
  static void refresh(State& state) { refresh_images(state); }
  /// Makes the next step renew the list.
  static void expire(State& state) { state.list_expired = true; }

  /// Puts grains in, between two steps. They stand behind the others and have no rows; the next step renews the
  /// list. Pre: nothing touches them; ids that are given are new. Post: put_in counts them; all that was known of
  /// the others is as before.
  static void insert(State& state, const std::vector<NewGrain>& grains);
  /// Takes out the grains in these slots with the next renewal, which must come before anything else moves.
  /// Post: taken_out counts them.
  void remove(State& state, const std::vector<Index>& slots);

  /// Where the forces of the rows go. Made anew where the list is not this object's (a state from a checkpoint).
  const ReactionMap& reactions(const State& state) {
    if (map_.list != state.list_builds) map_reactions(state, rules_.axis, map_);
    return map_;
  }

private:
  PairRules rules_;
  double smallest_margin_;  // m
  NeighbourScratch scratch_;
  ReactionMap map_;
};

}  // namespace wedge
