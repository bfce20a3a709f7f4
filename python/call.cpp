#include "python/call.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells/suggest.h"
#include "mesh/error.h"

namespace gsp::python {

namespace {

constexpr int kMostThreads = 1024;

AxisValue axis_value(const Axis& axis, const py::object& value) {
  const auto refuse = [&] {
    throw py::type_error(std::string(axis.name) + " cannot be " + std::string(py::repr(value)));
  };
  const bool whole = PyIndex_Check(value.ptr()) && !py::isinstance<py::bool_>(value);
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  try {
    if (axis.kind == Axis::Kind::Word && whole) return std::string(py::str(value));
    if (axis.kind == Axis::Kind::Integer && whole) return py::int_(value).cast<std::int64_t>();
    if (axis.kind == Axis::Kind::Number && !py::isinstance<py::bool_>(value)) return value.cast<double>();
  } catch (const py::cast_error&) {
  }
  refuse();
  return {};
}

}  // namespace

Call::Call(const char* function, const py::kwargs& keywords) : function_(function) {
  for (const auto& [name, value] : keywords) keywords_[name] = value;
  threads_ = take<int>("threads");
  if (threads_ && (*threads_ < 1 || *threads_ > kMostThreads))
    throw Error(Cause::BadOption,
                "threads: " + std::to_string(*threads_) + " is not 1 to " + std::to_string(kMostThreads));
  progress_ = take_object("progress");
  on_note_ = take_object("on_note");
}

py::object Call::take_object(const char* name) {
  known_.push_back(name);
  if (!keywords_.contains(name)) return py::none();
  return keywords_.attr("pop")(name);
}

void Call::take_options(const std::vector<std::string>& names, CellOptions& cell) {
  for (const std::string& name : names) {
    const py::object value = take_object(name.c_str());
    if (value.is_none()) continue;
    const Axis& option = axis(name);
    const AxisValue given = axis_value(option, value);
    if (const std::string why = option.refusal(given); !why.empty()) throw Error(Cause::BadOption, name + ": " + why);
    option.set(cell, given);
  }
}

void Call::refuse_others() const {
  if (keywords_.empty()) return;
  const std::string word = py::str(keywords_.begin()->first);
  const std::string meant = nearest_word(word, known_);
  throw py::type_error(std::string(function_) + "() has no keyword '" + word + "'" +
                       (meant.empty() ? "" : "; did you mean '" + meant + "'?"));
}

void Call::run(const std::function<void(Progress&)>& work) {
  refuse_others();
  // Called on the thread that called us, which holds no lock then.
  Progress progress([this](const std::string& stage, double fraction) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress_.is_none()) progress_(stage, fraction);
    return true;
  });
  progress.on_note([this](const std::string& sentence) {
    if (on_note_.is_none()) return;
    const py::gil_scoped_acquire lock;
    on_note_(sentence);
  });
  const py::gil_scoped_release unlocked;
  if (threads_)
    tbb::task_arena(*threads_).execute([&] { work(progress); });
  else
    work(progress);
}

std::vector<std::string> option_names(StageKind stage) {
  std::vector<std::string> names;
  for (const Axis& axis : axes())
    if (axis.stage == stage) names.push_back(axis.name);
  return names;
}

std::string options_text(const std::vector<std::string>& names, const CellOptions& defaults) {
  std::string text;
  for (const std::string& name : names) {
    const Axis& option = axis(name);
    std::string range;
    const bool method = name == "method";  // of which these functions take maps alone
    for (const std::string& word : method ? map_method_words() : option.words)
      range += (range.empty() ? "" : ", ") + word;
    if (option.kind != Axis::Kind::Word) {
      const auto number = [](double x) {
        return x == std::round(x) && std::abs(x) < 1e15 ? to_string(AxisValue(std::int64_t(x)))
                                                        : to_string(AxisValue(x));
      };
      range = number(option.low) + " to " + number(option.high) + (range.empty() ? "" : ", or " + range);
    }
    text += "    " + name + ": " + range + " [" + to_string(option.get(defaults)) + "]\n";
  }
  return text;
}

void bind_error(py::module_& module) {
  // Lives as long as the process: exceptions may come after the module is gone.
  static PyObject* const type = PyErr_NewExceptionWithDoc(
      "gsp.Error",
      "What went wrong: `cause`, a stable name such as 'non-manifold-edge'; `element`, 'vertex', 'edge', 'face', "
      "'line', "
      "'byte', 'component' or None; `index`, which one, or None; `end`, of an edge its second vertex, or None.",
      PyExc_RuntimeError, nullptr);
  if (!type) throw py::error_already_set();
  module.attr("Error") = py::reinterpret_borrow<py::object>(type);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      py::object value = py::reinterpret_borrow<py::object>(type)(error.what());
      value.attr("cause") = cause_name(error.cause());
      const std::optional<Place>& place = error.place();
      value.attr("element") = place ? py::object(py::str(element_name(place->element))) : py::none();
      value.attr("index") = place ? py::object(py::int_(place->index)) : py::none();
      value.attr("end") = place && place->end ? py::object(py::int_(*place->end)) : py::none();
      PyErr_SetObject(type, value.ptr());
    }
  });
}

}  // namespace gsp::python
