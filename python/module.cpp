#include "experiments/version.h"
#include "python/bindings.h"
#include "python/call.h"

PYBIND11_MODULE(_gsp, module) {
  using namespace gsp::python;
  module.doc() = "The compiled part of gsp.";
  module.attr("__version__") = gsp::version();
  bind_error(module);
  bind_surfaces(module);
  bind_map(module);
  bind_code(module);
  bind_measures(module);
  bind_results(module);
}
