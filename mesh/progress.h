#pragma once

#include <functional>
#include <string>

#include "mesh/error.h"

namespace gsp {

/// How a long stage tells what it does and asks whether to go on. Default-constructed it is silent.
/// Called from the thread that runs the stage only. Stages report at most a few hundred times.
class Progress {
 public:
  /// `callback(stage, fraction in [0,1])` returns false to cancel.
  using Callback = std::function<bool(const std::string& stage, double fraction)>;

  Progress() = default;
  explicit Progress(Callback callback) : callback_(std::move(callback)) {}

  /// Names what is done and how far it is. Throws Error(Cancelled) where the callback returns false.
  void report(const std::string& stage, double fraction) {
    if (callback_ && !callback_(stage, fraction)) throw Error(Cause::Cancelled, "cancelled during " + stage);
  }

  /// A remark for people, such as a rejected candidate or a repaired input; never needed to use the result.
  void note(const std::string& sentence) {
    if (notes_) notes_(sentence);
  }
  void on_note(std::function<void(const std::string&)> notes) { notes_ = std::move(notes); }

 private:
  Callback callback_;
  std::function<void(const std::string&)> notes_;
};

}  // namespace gsp
