#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/cells/cell_options.h"
#include "mesh/io.h"

namespace gsp {

/// Cells of a recipe on the same surfaces: a [[block]], or the part of it for surfaces with keys of their own.
struct RecipeBlock {
  std::vector<std::string> models;  ///< sources, see models.h
  std::vector<CellOptions> cells;   ///< normalized, each once, the method varying slowest
};

/// What a sweep is to compute.
struct Recipe {
  std::string name;
  std::string description;
  ReadOptions read;  ///< how the surfaces are read
  std::vector<RecipeBlock> blocks;
};

/// What is taken in place of what a recipe says.
struct RecipeOverrides {
  std::vector<std::string> models;  ///< empty for the recipe's
  std::optional<int> replicates;    ///< 1 to kMostReplicates, for all of its blocks
};

/// Reads a recipe (TOML):
///
///     name = "gamma-mu"                  # else the file's name
///     description = "..."
///     models = ["data/*.off", "shape:torus"]   # files by pattern, folders, generated shapes
///     weld = "exact"                     # or a share of the diagonal: which vertices of the surfaces are joined
///     repair = "cut"                     # or none: whether surfaces are cut apart where they are no manifolds
///     gamma = [0, 1, 2]                  # any axis of cell_options.h: one value, a list of them, or a range:
///     mu = { from = 0, to = 2, step = 0.5 }         # also { from, to, steps } and { from, to, factor }
///     budgets = [1024, 4096]             # bytes; else 256, 512, 1024, ...
///     replicates = 8                     # the same as replicate = [0, 1, ..., 7]: each cell so often, to learn its
///     chance preset = "paper"                   # what the map's options are that no key sets: one word or a list
///     [[block]]                          # any number: cells by the keys above, overridden by those of the block
///     method = ["draco"]
///     models = [{ path = "horse.ply", base_vertices = 140 }]   # a surface with keys that override for it alone
///
///     [[external]]                       # any number: somebody else's method, by command line (external_tool.h)
///     name = "draco-tool"                # on the file's models, or its own
///     encode = "draco_encoder -i {input} -o {output} -qp {value}"
///     decode = "draco_decoder -i {input} -o {output}"
///     values = [8, 10, 12]
///
/// The cells are all combinations. A surface that a pattern and a table name is one, with the table's keys. Of surfaces
/// that replace the recipe's, one called like the path of a table (folder and ending aside)
/// keeps that table's keys.
/// Throws Error: CannotOpen; Malformed where it is no TOML; BadOption with the line for unknown keys, impossible
/// values, an empty list, more than 100000 cells, a pattern that matches nothing, or a key that a block sets besides a
/// model from above it.
Recipe read_recipe(const std::string& path, const RecipeOverrides& overrides = {});

}  // namespace gsp
