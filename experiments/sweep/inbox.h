#pragma once

#include <vector>

#include "experiments/store/store.h"

namespace gsp {

/// Takes into the store what workers left in its inbox, in one transaction, and removes the files. What is killed in
/// between takes them in again, which changes nothing. A file that is no result (after a power failure) is dropped, and
/// its stage runs again. Throws what `Store::put` throws.
std::vector<StageResult> empty_inbox(Store& store);

}  // namespace gsp
