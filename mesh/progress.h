#pragma once

#include <functional>
#include <string>

#include "mesh/error.h"
#include "mesh/export.h"
#include "mesh/profile.h"

namespace GSP_PUBLIC gsp {

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
  /// One that reports and remarks here, with a name put before: "horse: encode". Valid as long as this one.
  Progress within(const std::string& name) {
    Progress inner([this, name](const std::string& stage, double fraction) {
      report(name + ": " + stage, fraction);
      return true;
    });
    inner.on_note([this, name](const std::string& sentence) { note(name + ": " + sentence); });
    inner.profile_ = profile_;
    return inner;
  }
  /// Begins a step of the profile, if there is one, that ends with the scope.
  [[nodiscard]] Profile::Scope step(const std::string& name) {
    return profile_ ? profile_->step(name) : Profile::Scope();
  }
  /// Has the steps timed there from now on, or no longer.
  void set_profile(Profile* profile) { profile_ = profile; }
  void on_note(std::function<void(const std::string&)> notes) { notes_ = std::move(notes); }

 private:
  Callback callback_;
  std::function<void(const std::string&)> notes_;
  Profile* profile_ = nullptr;
};

}  // namespace gsp
