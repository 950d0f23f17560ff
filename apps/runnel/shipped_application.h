#pragma once

#include <string>

namespace runnel::program {

/// The file that is meant by `word`: of an application that comes with Runnel, its name is enough (`bug_demo`). Files
/// that are there come first; a word that means neither is what it was.
[[nodiscard]] std::string ApplicationFile(const std::string& word);

}  // namespace runnel::program
