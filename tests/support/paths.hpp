#pragma once

#include <string>

/// Where the test suite finds what it reads. The places are compiled into one file, so that the objects of all others
/// are the same in every checkout.

/// @return the path of something below tests/
std::string test_data_path(const std::string& relative);
/// @return the path of something below designs/, of the folder itself where nothing is named
std::string designs_path(const std::string& relative = "");
