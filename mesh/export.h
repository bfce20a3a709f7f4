#pragma once

/// Marks the namespace in headers that an installed gsp has: what they declare is a symbol of the shared library. All
/// else is compiled with hidden visibility and stays inside. A compiler that knows no visibility passes it over.
#define GSP_PUBLIC [[gnu::visibility("default")]]
