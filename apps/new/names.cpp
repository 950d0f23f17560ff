#include "apps/new/names.h"

#include <algorithm>
#include <set>

namespace runnel::new_program {

namespace {

// All lower-case words that C++20 keeps for itself.
const std::set<std::string> kKeywords{
    "alignas",       "alignof",     "and",        "and_eq",    "asm",       "auto",
    "bitand",        "bitor",       "bool",       "break",     "case",      "catch",
    "char",          "class",       "co_await",   "co_return", "co_yield",  "compl",
    "concept",       "const",       "const_cast", "consteval", "constexpr", "constinit",
    "continue",      "decltype",    "default",    "delete",    "do",        "double",
    "dynamic_cast",  "else",        "enum",       "explicit",  "export",    "extern",
    "false",         "float",       "for",        "friend",    "goto",      "if",
    "inline",        "int",         "long",       "mutable",   "namespace", "new",
    "noexcept",      "not",         "not_eq",     "nullptr",   "operator",  "or",
    "or_eq",         "private",     "protected",  "public",    "register",  "reinterpret_cast",
    "requires",      "return",      "short",      "signed",    "sizeof",    "static",
    "static_assert", "static_cast", "struct",     "switch",    "template",  "this",
    "thread_local",  "throw",       "true",       "try",       "typedef",   "typeid",
    "typename",      "union",       "unsigned",   "using",     "virtual",   "void",
    "volatile",      "while",       "xor",        "xor_eq"};
// Names that the project's files or targets have already.
const std::set<std::string> kTaken{"all",    "build",  "clean", "install", "main",
                                   "plugin", "runnel", "test",  "world"};

bool IsLetter(char c) { return c >= 'a' && c <= 'z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// "WallFollower-2" could be "wall_follower_2".
std::string Proposal(const std::string& name) {
  std::string proposal;
  for (const char c : name) {
    const bool is_capital = c >= 'A' && c <= 'Z';
    const bool begins_word = is_capital || !(IsLetter(c) || IsDigit(c));
    if (begins_word && !proposal.empty() && proposal.back() != '_') proposal += '_';
    if (is_capital) proposal += static_cast<char>(c - 'A' + 'a');
    if (IsLetter(c) || (IsDigit(c) && !proposal.empty())) proposal += c;
  }
  while (proposal.ends_with('_')) proposal.pop_back();
  return proposal;
}

}  // namespace

Result<void> CheckName(const std::string& name) {
  const bool is_well_formed =
      !name.empty() && IsLetter(name.front()) && !name.ends_with('_') &&
      name.find("__") == std::string::npos &&
      std::ranges::all_of(name, [](char c) { return IsLetter(c) || IsDigit(c) || c == '_'; });
  if (!is_well_formed) {
    const std::string proposal = Proposal(name);
    return Error{.message = "nothing can be called '" + name +
                            "': names are lower-case letters, digits and single '_', and begin "
                            "with a letter",
                 .hint = proposal.empty() ? "" : "how about '" + proposal + "'?"};
  }
  if (kKeywords.contains(name)) {
    return Error{.message = "nothing can be called '" + name + "', which is a word of C++"};
  }
  if (kTaken.contains(name)) {
    return Error{.message = "nothing can be called '" + name +
                            "', which is the name of something else in each project"};
  }
  return {};
}

std::string ClassName(const std::string& name) {
  std::string class_name;
  bool begins_word = true;
  for (const char c : name) {
    if (c != '_') class_name += begins_word && IsLetter(c) ? static_cast<char>(c - 'a' + 'A') : c;
    begins_word = c == '_';
  }
  return class_name;
}

}  // namespace runnel::new_program
