// passes_linear_law.cpp: the passes compiled for the law LinearLaw.
#include "kernels/law_passes_impl.hpp"
#include "kernels/laws/linear_law.hpp"

namespace wedge {
template LawPasses make_law_passes<LinearLaw>(const Scene&, const State&, Friction, bool);
template LawPasses make_law_passes<TotalCoulomb<LinearLaw>>(const Scene&, const State&, Friction, bool);
}  // namespace wedge
