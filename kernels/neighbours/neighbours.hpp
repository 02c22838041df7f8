// neighbours.hpp: the passes that make the neighbour list anew, in their order. neighbour_list.cpp calls them.
#pragma once

#include "core/cell_grid.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// Working memory of the passes, kept between calls so that a step allocates nothing once sizes have settled.
struct NeighbourScratch {
  CellGrid grid;
  Array<std::int32_t> wrap;               // per grain: turns by which the last wrap turned it
  Array<std::int32_t> leaves;             // per grain: 1 when it leaves; empty when none does
  Array<Index> cell, order;               // per grain: its cell; old slot of each new slot
  Array<Index> next_in_cell;              // per cell, while it fills: where its next grain, or image, goes
  Array<Index> old_slot;                  // per grain: where it stood before the last sort
  Array<Index> grain_begin;               // per cell: first grain (grains are sorted by cell)
  Vec3Array places;                       // per grain, m; a pack of places far away behind the last
  Array<double> reach;                    // per grain: radius and margin, m; as many
  Array<Index> image_begin, image_order;  // per cell: its images, in image order
  Array<Index> image_cell;                // per image: its cell
  Array<double> real_buffer;              // where a field is put in order, before it becomes the field
  Array<std::int32_t> whole_buffer;
  Vec3Array vector_buffer;
  // What rows of the list before have stored, for carrying it on, by the slots grains had then.
  Array<Index> old_row_begin, old_wall_row, old_wall_row_end;
  Array<std::int32_t> old_partner, old_turn;
  Vec3Array old_history, old_rolling_moment;
  WallContactTable old_walls;
};

/// What makes a pair of grains a row of the list, and what the row keeps.
struct PairRules {
  AxisRule axis;
  bool couples = false;  // rows keep a rolling couple and the moment of a rolling spring
};

/// What contacts see of the grains from slot `from` on is what they are now.
void show_grains(Particles& particles, Index from);

/// How far each grain may go before the list is stale, from its speed and from what lists and pairs cost.
/// Pre: dt > 0 [s]. `smallest` [m] bounds the margins from below. Post: list_margin, wall_margin are set; reference
/// is the position.
void choose_margins(State& state, double smallest, double dt);

/// Keeps histories of the rows that store something, by who touches whom: all that the next list can want of this
/// one. Pre: grains and images stand where the list was made for; it comes before what follows here.
void set_contacts_aside(const State& state, NeighbourScratch& scratch);

/// Turns grains that left through a face home: position, velocities, forces. Post: scratch.wrap holds their turns.
void wrap(State& state, NeighbourScratch& scratch);

/// Sorts the grains by cell, then id; those marked in scratch.leaves drop out.
/// Post: grains of a cell are consecutive; scratch.old_slot says whence they came.
void sort_by_cell(State& state, NeighbourScratch& scratch);

/// Writes the copies of grains near the faces behind the grains. Post: images.owner ascends; radius, mass, material
/// of the images are set; positions and velocities are refreshed.
void make_images(State& state, AxisRule axis);

/// Moves images with their owners: x, v and w as seen, turned by the image's turn. An index-mapped pass.
void refresh_images(State& state);

/// Finds all pairs closer than the sum of radii and margins, once each, histories carried over by identity. A grain
/// meets its own copies where meets_itself(axis) says so.
/// Throws PhysicsError when two grains overlap by more than `overlap_limit` of the smaller radius.
void find_contacts(State& state, NeighbourScratch& scratch, const PairRules& rules);

/// Finds all wall features near each grain, histories carried over. Pre: find_contacts listed places and reach.
/// Throws PhysicsError when a grain overlaps a wall by more than `wall_overlap_limit` of its radius.
void find_wall_contacts(State& state, NeighbourScratch& scratch);

/// Throws PhysicsError when a grain's position or velocity is not a number or it moves too far in a step.
void check_motion(const State& state, double dt);

// Overlaps are looked at when a list is made; until the next one a pair may come closer by its two margins, a grain
// to a wall by its own.
inline constexpr double overlap_limit = 0.6;  // of the smaller radius
// Of the radius: as deep as each of two equal grains at their limit reaches beyond the plane between them.
inline constexpr double wall_overlap_limit = 0.5 * overlap_limit;
inline constexpr double largest_way_per_step = 0.5;  // radii

}  // namespace wedge
