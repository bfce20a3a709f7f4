#pragma once

#include <string>
#include <vector>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

/// CPU time of this process so far, all threads, and of its children that have ended, as external methods do.
double process_cpu_seconds();

/// What a step took, all its runs together, with the steps inside it.
struct ProfileStep {
  std::string name;
  int depth = 0;                ///< steps that it is inside of
  int runs = 0;                 ///< how often it ended
  double seconds = 0.0;         ///< wall
  double cpu_seconds = 0.0;     ///< of the whole process
  double peak_megabytes = 0.0;  ///< most memory of the whole process while it ran, in 10^6 bytes
};

/// Times the steps of a run as a tree; steps of one name inside the same step are one. The kernel's record of the
/// process's peak memory is begun anew with each step, so other readers of that record see the last step's; where the
/// kernel does not allow it, a peak is that since the process began. From one thread only. A step costs about 20 us.
class Profile {
 public:
  /// Ends a step where it goes out of scope, or is told to. Scopes end in the reverse of the order in which they began.
  class Scope {
   public:
    Scope() = default;  ///< of no step
    Scope(Scope&& other) noexcept : profile_(other.profile_) { other.profile_ = nullptr; }
    Scope& operator=(Scope&&) = delete;
    ~Scope() { end(); }
    void end() {
      if (profile_) profile_->end();
      profile_ = nullptr;
    }

   private:
    friend class Profile;
    explicit Scope(Profile* profile) : profile_(profile) {}
    Profile* profile_ = nullptr;
  };

  [[nodiscard]] Scope step(const std::string& name);

  /// All steps, each followed by those inside it, in the order in which they first began. None may be under way.
  std::vector<ProfileStep> steps() const;

 private:
  struct Node {
    ProfileStep step;
    std::vector<int> inside;
  };
  struct Open {
    int node;
    double wall, cpu;
  };

  void end();
  void take_peak();
  void list(const std::vector<int>& nodes, std::vector<ProfileStep>& all) const;

  std::vector<Node> nodes_;
  std::vector<int> outermost_;
  std::vector<Open> open_;
};

}  // namespace gsp
