#pragma once

#include <string>

/// Folder of meshes that are not part of the repository: GSP_SHARED_MESHES, or shared/meshes beside the checkout.
/// Empty where there is none; the running test then says (Catch's WARN) that this part of it is skipped.
std::string shared_meshes();

/// Folder of the Debian package libcgal-demo's meshes (OFF), which ./run-tests fetches: GSP_SAMPLES, or out/samples.
/// Empty, with a warning, where there is none.
std::string sample_meshes();
