#pragma once

#include "param/corners/relax_corners.h"
#include "param/options.h"

namespace gsp {

/// Moves interior corners down the gradient of the energy that the map is a minimum of: Dirichlet's for
/// Objective::Linear (exactly so with cotangent weights), `DistortionEnergy`'s for Objective::Distortion. At a minimum
/// the energy does not change to first order with the vertices, so its derivative by a corner's place is that by
/// carrying the map along with the corner, an integral of Eshelby's stress over the disc around it: no equation is
/// solved. Each corner goes to a vertex down that gradient for which the energy of its disc, with the map carried
/// along, becomes lower (Armijo); it stays where there is none. Returns how many moved; the map is no longer a minimum.
int descend_corners(Atlas& atlas, Objective objective, double radius, Folding folding);

}  // namespace gsp
