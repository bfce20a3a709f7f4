#include "experiments/recipe.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "mesh/error.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

Recipe recipe_of(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.file("study.toml");
  std::ofstream(path) << text;
  return read_recipe(path);
}

// The refusal of a recipe whose second line is `line`: "sentence (line N)" without the file's name.
std::string refusal(const std::string& line, long long at = 2) {
  try {
    recipe_of("models = [\"shape:torus\"]\n" + line + "\n");
  } catch (const Error& error) {
    CHECK(error.element() == Element::Line);
    CHECK(error.index().value_or(-1) == at);
    return error.what();
  }
  return "accepted";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<double> gammas(const std::string& values) {
  std::vector<double> found;
  const Recipe recipe = recipe_of("models = [\"shape:torus\"]\ngamma = " + values);
  for (const CellOptions& cell : recipe.blocks.front().cells) found.push_back(cell.parameterize.gamma);
  return found;
}

}  // namespace

TEST_CASE("a recipe is all combinations of its lists, with the program's defaults for the rest") {
  const Recipe recipe = recipe_of(
      "models = [\"shape:torus\", \"shape:sphere\"]\nmethod = [\"gsp\", \"maps\"]\ngamma = [0, 1.5]\n"
      "base_vertices = [\"auto\", 50]\nbudgets = [4096, 512]\n");
  CHECK(recipe.name == "study");
  REQUIRE(recipe.blocks.size() == 1);
  CHECK(recipe.blocks[0].models == std::vector<std::string>{"shape:torus", "shape:sphere"});
  const std::vector<CellOptions>& cells = recipe.blocks[0].cells;
  REQUIRE(cells.size() == 8);
  CHECK(cells[0].method == "gsp");
  CHECK(cells[0].parameterize.base_vertices == 0);
  CHECK(cells[1].parameterize.base_vertices == 50);
  CHECK(cells[7].method == "maps");
  CHECK(cells[7].parameterize.gamma == 1.5);
  CHECK(cells[7].budgets == std::vector<std::size_t>{512, 4096});
  CHECK(cells[0].parameterize.mu == ParameterizeOptions{}.mu);
}

TEST_CASE("blocks override what stands above them, and cells that cannot differ are one") {
  const Recipe recipe = recipe_of(
      "name = \"two\"\nmodels = [\"shape:torus\"]\ngamma = [0, 1, 2]\n[[block]]\n[[block]]\nmethod = \"draco\"\n"
      "models = [\"shape:dish\"]\n[[block]]\nmethod = \"maps\"\nrelaxations = [0, 1]\ngamma = 2\n");
  CHECK(recipe.name == "two");
  REQUIRE(recipe.blocks.size() == 3);
  CHECK(recipe.blocks[0].cells.size() == 3);
  CHECK(recipe.blocks[1].cells.size() == 1);
  CHECK(recipe.blocks[1].models == std::vector<std::string>{"shape:dish"});
  CHECK(recipe.blocks[2].cells.size() == 1);
}

TEST_CASE("ranges go by step, by number of steps or by factor, and end where they should") {
  CHECK(gammas("{ from = 0, to = 1, step = 0.1 }").size() == 11);
  CHECK(gammas("{ from = 0, to = 1, step = 0.1 }")[3] == 0.3);
  CHECK(gammas("{ from = 1, to = 2, steps = 3 }") == std::vector<double>{1.0, 1.5, 2.0});
  CHECK(gammas("{ from = 0.25, to = 4, factor = 2 }") == std::vector<double>{0.25, 0.5, 1.0, 2.0, 4.0});
}

TEST_CASE("what a recipe cannot mean is refused with the line") {
  CHECK(says(refusal("gama = 1"), "unknown key gama; did you mean gamma?"));
  CHECK(says(refusal("gamma = -1"), "gamma: -1 is not 0 to"));
  CHECK(says(refusal("gamma = nan"), "gamma: nan is not"));
  CHECK(says(refusal("gamma = []"), "empty list"));
  CHECK(says(refusal("gamma = [1,\n 2,\n -3]", 4), "-3 is not 0 to"));
  CHECK(says(refusal("gamma = { from = 0, to = 1 }"), "lacks step"));
  CHECK(says(refusal("gamma = { from = 0, to = 1, step = 0 }"), "never ends"));
  CHECK(says(refusal("gamma = { from = 0, to = 1, factor = 2 }"), "never ends"));
  CHECK(says(refusal("gamma = { from = 2, to = 1, step = 1 }"), "empty"));
  CHECK(says(refusal("gamma = { from = 0, to = 1, step = 1e-9 }"), "more than"));
  CHECK(says(refusal("gamma = { from = 0, to = 1, stride = 1 }"), "not stride"));
  CHECK(says(refusal("gamma = true"), "no number"));
  CHECK(says(refusal("level = 0.5"), "level: 0.5 is not an integer"));
  CHECK(says(refusal("level = { from = 0, to = 1, step = 0.5 }"), "takes integers"));
  CHECK(says(refusal("base_vertices = \"all\""), "or auto"));
  CHECK(says(refusal("wavelet = \"haar\""), "haar is none of"));
  CHECK(says(refusal("wavelet = { from = 0, to = 1, step = 1 }"), "takes words"));
  CHECK(says(refusal("method = \"gps\""), "gps is none of gsp"));
  CHECK(says(refusal("budgets = [0]"), "positive"));
  CHECK(says(refusal("budgets = []"), "budgets"));
  CHECK(says(refusal("[[block]]\nmodels = [\"shape:tours\"]", 3), "did you mean torus?"));
  CHECK(says(refusal("[[block]]\nmodels = [\"no/such/*.ply\"]", 3), "no file matches"));
  CHECK(says(refusal("[[block]]\nname = \"x\"", 3), "unknown key name"));
  CHECK(says(refusal("gamma = = 1"), "study.toml"));
  CHECK_THROWS_AS(recipe_of("gamma = 1\n"), Error);
  CHECK_THROWS_AS(read_recipe("no/such/recipe.toml"), Error);
}

TEST_CASE("models given instead replace those of the recipe, also where those are not there") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("study.toml")) << "models = [\"no/such.ply\"]\n";
  const Recipe recipe = read_recipe(folder.file("study.toml"), {"shape:dish"});
  CHECK(recipe.blocks.front().models == std::vector<std::string>{"shape:dish"});
}
