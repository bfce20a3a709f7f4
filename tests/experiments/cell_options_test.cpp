#include "experiments/cells/cell_options.h"

#include <catch2/catch.hpp>

#include "mesh/error.h"

using namespace gsp;

TEST_CASE("every axis takes its own default and survives the way through JSON") {
  CellOptions options;
  for (const Axis& axis : axes()) {
    INFO(axis.name);
    const AxisValue value = axis.get(options);
    CHECK(axis.refusal(value).empty());
    axis.set(options, value);
    CHECK(axis.get(options) == value);
  }
  options.parameterize.gamma = 0.25;
  options.parameterize.base_vertices = 150;
  options.remesh.kind = RemeshKind::VariationalNormal;
  options.encode.wavelet = Wavelet::Butterfly;
  options.budgets = {1000, 2000};
  const std::string text = options_json(options);
  const CellOptions back = options_from_json(text);
  CHECK(options_json(back) == text);
  CHECK(back.budgets == options.budgets);
  CHECK(back.remesh.kind == RemeshKind::VariationalNormal);
  CHECK(back.parameterize.gamma == 0.25);
}

TEST_CASE("impossible values are refused with the reason") {
  CHECK(axis("gamma").refusal(-1.0) == "-1 is not 0 to 1000000");
  CHECK(axis("relaxations").refusal(std::int64_t{-1}) == "-1 is not an integer 0 to 1000");
  CHECK(axis("relaxations").refusal(0.5) == "0.5 is not an integer 0 to 1000");
  CHECK(axis("base_vertices").refusal(std::string("many")) ==
        "many is not an integer 4 to 2147483647 or auto or auto-omega");
  CHECK(axis("base_vertices").refusal(std::string("auto")).empty());
  CHECK(axis("tangential_ratio").refusal(std::int64_t{3}) == "3 is none of 1, 2, 4, 8");
  CHECK(axis("wavelet").refusal(std::string("haar")).find("haar is none of loop") == 0);
  CHECK_FALSE(axis("gamma").refusal(std::numeric_limits<double>::quiet_NaN()).empty());
  CHECK_THROWS_AS(axis("gama"), Error);
  CHECK_THROWS_AS(options_from_json("[]"), Error);
  CHECK_THROWS_AS(options_from_json("{\"gamma\": -3.0}"), Error);
}

TEST_CASE("options that change nothing for a method do not make cells differ") {
  const auto of_method = [](const char* method) {
    CellOptions options;
    options.method = method;
    return options;
  };
  CellOptions maps = of_method("maps"), draco = of_method("draco"), gsp = of_method("gsp");
  for (CellOptions* options : {&maps, &draco, &gsp}) options->parameterize.relaxations = 0;
  draco.parameterize.gamma = 0.0;
  draco.budgets = {1};
  CHECK(options_json(normalized(maps)) == options_json(of_method("maps")));
  CHECK(options_json(normalized(draco)) == options_json(of_method("draco")));
  CHECK(options_json(normalized(gsp)) != options_json(of_method("gsp")));
  CHECK(options_json(draco, StageKind::Parameterize) == "{}");
  // A cached remesh is another one where its kind is.
  CellOptions normal = of_method("gsp");
  normal.remesh.kind = RemeshKind::Normal;
  CHECK(options_json(normal, StageKind::Remesh) != options_json(of_method("gsp"), StageKind::Remesh));
  CHECK(options_json(normal, StageKind::Parameterize) == options_json(of_method("gsp"), StageKind::Parameterize));
}

TEST_CASE("further options are read back from their text") {
  CellOptions options;
  options.remesh.positions = Positions::Closest;
  const std::string text = further_options(options);
  CHECK(further_option(text, "positions") == "closest");
  CHECK(further_option(text, "osition").empty());
  CHECK(further_option("a=b=c d=", "a") == "b=c");
  CHECK(further_option("a=b d=", "d").empty());
  options.method = "draco";
  CHECK(further_option(further_options(options), "positions").empty());
}
