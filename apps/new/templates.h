#pragma once

#include <map>
#include <string>

namespace runnel::new_program {

/// What the files of templates/ say, by their names without ".in".
[[nodiscard]] const std::map<std::string, std::string>& Templates();

}  // namespace runnel::new_program
