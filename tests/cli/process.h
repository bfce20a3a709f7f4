#pragma once

#include <string>

#include "cli.h"
#include "temporary_folder.h"

/// The program itself, in a process of its own: neither a crash nor a hang (status 124) takes the test with it.
/// `before`: shell commands ahead of it, such as a limit.
Ran gsp_process(const std::string& arguments, const TemporaryFolder& folder, const std::string& before = {});
