#pragma once

namespace gsp {

/// Bytes that the machine could give without swapping (MemAvailable), or a number beyond any where it does not say.
double available_memory();

/// Bytes of memory that the process holds now, or 0 where the machine does not say.
double resident_memory();

}  // namespace gsp
