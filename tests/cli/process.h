#pragma once

#include <string>

#include "cli.h"
#include "temporary_folder.h"

/// The program itself, in a process of its own: neither a crash nor a hang (status 124) takes the test with it.
/// `before`: shell commands ahead of it, such as a limit.
Ran gsp_process(const std::string& arguments, const TemporaryFolder& folder, const std::string& before = {});

/// The shell command that limits a process to so many KB of address space, for `before`. Nothing in a build with
/// AddressSanitizer, whose shadow alone takes terabytes of it.
std::string address_space(int kb);
