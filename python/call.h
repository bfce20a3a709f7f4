#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cells/cell_options.h"
#include "mesh/progress.h"

namespace gsp::python {

namespace py = pybind11;

/// The keywords of one call. Those that all long calls have are taken out at once: `threads`, `progress`, `on_note`.
/// The function takes its own, and `run` refuses what is left.
class Call {
 public:
  Call(const char* function, const py::kwargs& keywords);

  /// The value of a keyword, or none where it is missing or None. Throws TypeError for a value of another type.
  template <class T>
  std::optional<T> take(const char* name) {
    const py::object value = take_object(name);
    if (value.is_none()) return std::nullopt;
    try {
      return value.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(function_) + "(): " + name + " cannot be " + std::string(py::repr(value)));
    }
  }
  py::object take_object(const char* name);

  /// Keywords that are options of the stages, as the command line has them (`axes`), into `cell`.
  /// Throws Error(BadOption) for a value out of its range, TypeError for one of another type.
  void take_options(const std::vector<std::string>& names, CellOptions& cell);

  /// Calls `work` without Python's lock, on at most `threads` threads. A signal that Python's handler turns into an
  /// exception (Ctrl-C), and an exception of the caller's callbacks, end it.
  /// Throws TypeError for keywords that nothing took.
  void run(const std::function<void(Progress&)>& work);

 private:
  void refuse_others() const;

  const char* function_;
  py::dict keywords_;
  std::vector<std::string> known_;
  std::optional<int> threads_;
  py::object progress_, on_note_;
};

/// Names of the stage's options (`axes`).
std::vector<std::string> option_names(StageKind stage);

/// "gamma: 0 to 1000, default 2.0", a line for each option, for the documentation of a function.
std::string options_text(const std::vector<std::string>& names, const CellOptions& defaults);

/// Makes gsp.Error, and turns ours into it.
void bind_error(py::module_& module);

}  // namespace gsp::python
