#include "experiments/cells/recipe.h"

#include <catch2/catch.hpp>
#include <filesystem>
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
  CHECK(cells[0].parameterize.base_vertices == kBaseByRate);
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

TEST_CASE("a model's own keys override for it alone, and models keep their order") {
  const Recipe recipe = recipe_of(
      "base_vertices = 50\nmodels = [\"shape:torus\", { path = \"shape:dish\", base_vertices = [15, 20] },\n"
      "  { path = \"shape:sphere\", budgets = [64] }, \"shape:genus-2\"]\n[[block]]\n[[block]]\ngamma = [0, 1]\n");
  REQUIRE(recipe.blocks.size() == 8);
  CHECK(recipe.blocks[0].models == std::vector<std::string>{"shape:torus"});
  REQUIRE(recipe.blocks[1].cells.size() == 2);
  CHECK(recipe.blocks[1].models == std::vector<std::string>{"shape:dish"});
  CHECK(recipe.blocks[1].cells[1].parameterize.base_vertices == 20);
  CHECK(recipe.blocks[2].cells[0].parameterize.base_vertices == 50);
  CHECK(recipe.blocks[2].cells[0].budgets == std::vector<std::size_t>{64});
  CHECK(recipe.blocks[3].cells[0].parameterize.base_vertices == 50);
  CHECK(recipe.blocks[5].cells.size() == 4);
}

TEST_CASE("a surface that a pattern and a table name is one, with the table's keys") {
  const Recipe recipe = recipe_of("models = [\"shape:torus\", { path = \"shape:torus\", base_vertices = 15 }]\n");
  REQUIRE(recipe.blocks.size() == 1);
  CHECK(recipe.blocks[0].models == std::vector<std::string>{"shape:torus"});
  CHECK(recipe.blocks[0].cells[0].parameterize.base_vertices == 15);
}

TEST_CASE("a preset stands for options of the map, which keys override") {
  const Recipe recipe = recipe_of(
      "models = [\"shape:torus\"]\npreset = [\"default\", \"paper\"]\ngamma = [1, 2]\n[[block]]\n"
      "[[block]]\npreset = \"paper\"\nobjective = \"distortion\"\n");
  const std::vector<CellOptions>& cells = recipe.blocks[0].cells;
  REQUIRE(cells.size() == 4);
  CHECK(cells[0].parameterize.objective == Objective::Distortion);
  CHECK(cells[3].parameterize.objective == paper_options().objective);
  CHECK(cells[3].parameterize.gamma == 2.0);
  CHECK(recipe.blocks[1].cells[0].parameterize.objective == Objective::Distortion);
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
  CHECK(says(refusal("[[block]]\nmodels = [\"no/such/*.ply\"]", 3), "--models takes other surfaces"));
  CHECK(says(refusal("preset = \"papper\""), "preset is none of default, paper"));
  CHECK(says(refusal("preset = []"), "empty list"));
  const auto model = [](const std::string& entry, long long at = 4) {
    return refusal("[[block]]\nmodels = [\n" + entry + "]", at);
  };
  CHECK(says(model("{ path = \"shape:torus\", base_vertice = 15 }"), "did you mean base_vertices?"));
  CHECK(says(model("{ path = \"shape:torus\", base_vertices = 3 }"), "base_vertices: 3 is not"));
  CHECK(says(model("{ base_vertices = 15 }"), "no table with one as path"));
  CHECK(says(model("15"), "no pattern of files"));
  CHECK(says(model("{ path = \"shape:torus\", gamma = 1 },\n{ path = \"shape:torus\", gamma = 2 }", 5), "keys twice"));
  CHECK(says(refusal("[[block]]\nmodels = [{ path = \"no/such.ply\", gamma = 1 }]", 3), "no file matches"));
  CHECK(says(refusal("gamma = = 1"), "study.toml"));
  CHECK_THROWS_AS(recipe_of("gamma = 1\n"), Error);
  CHECK_THROWS_AS(read_recipe("no/such/recipe.toml"), Error);
}

TEST_CASE("models given instead replace those of the recipe, also where those are not there") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("study.toml")) << "models = [\"no/such.ply\"]\n";
  const Recipe recipe = read_recipe(folder.file("study.toml"), {{"shape:dish"}, {}});
  CHECK(recipe.blocks.front().models == std::vector<std::string>{"shape:dish"});
}

TEST_CASE("a model given instead keeps the keys of the recipe's model that is called the same, wherever it lies") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("study.toml")) << "models = [{ path = \"no/such/horse*.ply\", base_vertices = 140 }]\n";
  for (const char* name : {"horse_48485.off", "cow.off"}) std::ofstream(folder.file(name)) << "OFF\n";
  const Recipe recipe = read_recipe(folder.file("study.toml"), {{folder.file("*.off"), folder.file("cow.off")}, {}});
  REQUIRE(recipe.blocks.size() == 2);
  CHECK(recipe.blocks[0].models == std::vector<std::string>{folder.file("cow.off")});
  CHECK(recipe.blocks[0].cells[0].parameterize.base_vertices == kBaseByRate);
  CHECK(recipe.blocks[1].cells[0].parameterize.base_vertices == 140);
}

TEST_CASE("a key that a block sets besides a model above it is refused with both lines") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("study.toml"))
      << "models = [{ path = \"shape:torus\", base_vertices = 15 }]\n[[block]]\nbase_vertices = 20\n";
  try {
    read_recipe(folder.file("study.toml"));
    FAIL("accepted");
  } catch (const Error& error) {
    CHECK(error.index().value_or(-1) == 3);
    CHECK(says(error.what(), "for shape:torus above (line 1)"));
  }
}

TEST_CASE("the recipes that come with the program say what they mean, and describe themselves") {
  int recipes = 0;
  for (const auto& entry : std::filesystem::directory_iterator("experiments/recipes")) {
    if (entry.path().extension() != ".toml") continue;  // scripts and points that recipes name
    CAPTURE(entry.path());
    const Recipe recipe = read_recipe(entry.path().string(), {{"shape:torus"}, {}});
    CHECK(recipe.name == entry.path().stem());
    CHECK_FALSE(recipe.description.empty());
    CHECK_FALSE(recipe.blocks.empty());
    ++recipes;
  }
  CHECK(recipes >= 10);
}

TEST_CASE("blocks that spell one surface differently mean one model") {
  const TemporaryFolder folder;
  std::ofstream(folder.file("m.off")) << "x";
  const std::string path = folder.path().string();
  const Recipe recipe = recipe_of("[[block]]\nmodels = [\"" + path + "/m.off\", \"" + path +
                                  "/./m.off\"]\n[[block]]\nmodels = [\"" + path + "//m.off\"]\n");
  REQUIRE(recipe.blocks.size() == 2);
  CHECK(recipe.blocks[0].models == std::vector<std::string>{path + "/m.off"});
  CHECK(recipe.blocks[1].models == recipe.blocks[0].models);
}

TEST_CASE("a recipe says which vertices of its surfaces are joined, and may begin with a byte order mark") {
  CHECK(recipe_of("models = [\"shape:torus\"]\n").read.repair == Repair::None);
  CHECK(recipe_of("models = [\"shape:torus\"]\nrepair = \"cut\"\n").read.repair == Repair::Cut);
  CHECK(says(refusal("repair = \"glue\""), "repair is none of none, cut"));
  CHECK_FALSE(recipe_of("models = [\"shape:torus\"]\n").read.weld.has_value());
  CHECK(recipe_of("models = [\"shape:torus\"]\nweld = \"exact\"\n").read.weld == 0.0);
  CHECK(recipe_of("models = [\"shape:torus\"]\nweld = 1e-6\n").read.weld == 1e-6);
  for (const char* weld : {"\"near\"", "-1", "0.5", "nan", "[0.001]", "true"})
    CHECK(says(refusal(std::string("weld = ") + weld), "weld is not"));
  CHECK(recipe_of("\xef\xbb\xbfmodels = [\"shape:torus\"]\nweld = 0\n").read.weld == 0.0);
}

TEST_CASE("replicates = N are N cells that differ in the replicate alone, once for the anchors") {
  const Recipe recipe =
      recipe_of("models = [\"shape:torus\"]\nmethod = [\"gsp\", \"draco\"]\ngamma = [0, 1]\nreplicates = 3\n");
  const std::vector<CellOptions>& cells = recipe.blocks.front().cells;
  REQUIRE(cells.size() == 2 * 3 + 1);
  for (int r = 0; r < 3; ++r) {
    CHECK(cells[static_cast<std::size_t>(r)].parameterize.gamma == 0.0);
    CHECK(cells[static_cast<std::size_t>(r)].parameterize.replicate == r);
  }
  CHECK(cells.back().method == "draco");
  CHECK(cells.back().parameterize.replicate == 0);

  CHECK(recipe_of("models = [\"shape:torus\"]\nreplicate = [4, 9]\n").blocks.front().cells[1].parameterize.replicate ==
        9);
  CHECK(says(refusal("replicates = 0"), "replicates is no integer of 1 to 1000"));
  CHECK(says(refusal("replicates = [2]"), "replicates is no integer"));
  CHECK(says(refusal("replicates = 2\nreplicate = 1"), "give one of them"));
  CHECK(says(refusal("replicate = -1"), "replicate: -1 is not"));

  const TemporaryFolder folder;
  std::ofstream(folder.file("study.toml")) << "models = [\"shape:torus\"]\nreplicate = [4, 9, 11]\n";
  const Recipe overridden = read_recipe(folder.file("study.toml"), {{}, 2});
  REQUIRE(overridden.blocks.front().cells.size() == 2);
  CHECK(overridden.blocks.front().cells[1].parameterize.replicate == 1);
}
