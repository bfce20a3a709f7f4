#pragma once

/// All of the library gsp::gsp. Programs may as well include the parts they use, as <gsp/mesh/mesh.h>. The anchors,
/// <gsp/coder/anchors.h>, are a library of their own, gsp::anchors.

#include "coder/codec.h"
#include "mesh/error.h"
#include "mesh/features/features.h"
#include "mesh/io.h"
#include "mesh/mesh.h"
#include "mesh/parallel.h"
#include "mesh/progress.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "mesh/weld.h"
#include "metrics/bd_rate.h"
#include "metrics/distortion.h"
#include "metrics/hausdorff.h"
#include "metrics/metro.h"
#include "metrics/psnr.h"
#include "metrics/smoothness.h"
#include "metrics/surface_distance.h"
#include "param/map/param_file.h"
#include "param/map/parameterization.h"
#include "param/parameterize.h"
#include "remesh/recover_levels.h"
#include "remesh/remesh.h"
#include "remesh/semiregular.h"
#include "remesh/semiregular_file.h"
