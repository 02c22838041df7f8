// passes_mindlin_deresiewicz.cpp: the passes compiled for the law MindlinDeresiewicz.
#include "kernels/law_passes_impl.hpp"
#include "kernels/laws/mindlin_deresiewicz.hpp"

namespace wedge {
template LawPasses make_law_passes<MindlinDeresiewicz>(const Scene&, const State&, Friction, bool);
template LawPasses make_law_passes<TotalCoulomb<MindlinDeresiewicz>>(const Scene&, const State&, Friction, bool);
}  // namespace wedge
