#pragma once

namespace gsp {

/// CPU seconds of a fixed piece of work on one thread (sorting and square roots, none of gsp's own algorithms): the
/// unit in which times of different machines, and of different loads of one, are compared. The best of three; about 0.1
/// s.
double reference_task_seconds();

}  // namespace gsp
