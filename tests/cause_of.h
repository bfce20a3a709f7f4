#pragma once

#include "mesh/error.h"

/// The cause with which `body` fails; Internal where it does not fail.
template <class Body>
gsp::Cause cause_of(Body&& body) {
  try {
    body();
  } catch (const gsp::Error& error) {
    return error.cause();
  }
  return gsp::Cause::Internal;
}
