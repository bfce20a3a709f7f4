#include "param/options.h"

#include "mesh/words.h"

namespace gsp {

ParameterizeOptions paper_options() {
  ParameterizeOptions options;
  options.objective = Objective::Linear;
  options.weights = Weights::MeanValue;
  options.base_edges = BaseEdges::Keep;
  return options;
}

const char* objective_name(Objective objective) { return objective == Objective::Linear ? "linear" : "distortion"; }

const char* weights_name(Weights weights) {
  switch (weights) {
    case Weights::MeanValue:
      return "mean-value";
    case Weights::Cotangent:
      return "cotangent";
    case Weights::Uniform:
      return "uniform";
  }
  return "unknown";
}

const char* corners_name(Corners corners) { return corners == Corners::Gradient ? "gradient" : "relax"; }

const char* base_edges_name(BaseEdges base_edges) { return base_edges == BaseEdges::Flip ? "flip" : "keep"; }

const char* priority_name(Priority priority) { return priority == Priority::Maps ? "maps" : "omega"; }

const char* method_name(Method method) {
  switch (method) {
    case Method::Gsp:
      return "gsp";
    case Method::Maps:
      return "maps";
    case Method::MapsSmoothed:
      return "maps-smoothed";
    case Method::Hybrid:
      return "hybrid";
  }
  return "unknown";
}

Method method_of(const std::string& word) { return value_of(kMethods, method_name, word, "method"); }

Objective objective_of(const std::string& word) { return value_of(kObjectives, objective_name, word, "objective"); }

Weights weights_of(const std::string& word) { return value_of(kWeights, weights_name, word, "weights"); }

Corners corners_of(const std::string& word) { return value_of(kCorners, corners_name, word, "way of corners"); }

BaseEdges base_edges_of(const std::string& word) {
  return value_of(kBaseEdges, base_edges_name, word, "way of base edges");
}

Priority priority_of(const std::string& word) { return value_of(kPriorities, priority_name, word, "priority"); }

}  // namespace gsp
