#pragma once

namespace gsp {

/// Bytes that the machine could give without swapping (MemAvailable), or a number beyond any where it does not say.
double available_memory();

/// Most bytes that the process held since it began, or since the kernel's record of it was begun anew (proc(5),
/// clear_refs).
double peak_memory();

/// Bytes of memory that the process holds now, or 0 where the machine does not say.
double resident_memory();

}  // namespace gsp
