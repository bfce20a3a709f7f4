#pragma once

namespace gsp {

/// Release number, with the commit where it was built from a repository ("0.1.0+1a2b3c4"): it goes into every result.
const char* version();

}  // namespace gsp
