#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/types/value_tokens.h"

namespace runnel {

/// One value within a JSON text (RFC 8259), for requests, whose shape only those know who read them.
/// Copies share what has been read; it lives as long as one of them.
/// Threads: never changes; any thread.
class JsonPart {
 public:
  /// Errors: the text is no JSON, or has more than `deepest` lists and objects inside of one another, or a number
  /// beyond 1e4932; with the line and the column (bytes, from 1) where that shows.
  [[nodiscard]] static Result<JsonPart> Parse(std::string_view text, int deepest = ValueTokens::kDeepest);

  [[nodiscard]] bool is_object() const noexcept { return Is(ValueToken::Kind::kStructure); }
  [[nodiscard]] bool is_list() const noexcept { return Is(ValueToken::Kind::kList); }
  [[nodiscard]] bool is_null() const noexcept { return IsWord("null"); }

  // Nothing, or empty, if it is none.
  [[nodiscard]] std::optional<bool> boolean() const;
  [[nodiscard]] std::optional<std::string> text() const;
  [[nodiscard]] std::optional<double> number() const;
  /// A whole number, not below 0.
  [[nodiscard]] std::optional<std::uint64_t> count() const;
  [[nodiscard]] std::vector<JsonPart> items() const;
  [[nodiscard]] std::vector<std::pair<std::string, JsonPart>> members() const;

  /// Booleans, numbers and null are words: numbers with all their digits.
  [[nodiscard]] const ValueToken& token() const noexcept { return *token_; }

 private:
  explicit JsonPart(std::shared_ptr<const ValueToken> token) : token_(std::move(token)) {}
  [[nodiscard]] JsonPart Part(const ValueToken* token) const {
    return JsonPart(std::shared_ptr<const ValueToken>(token_, token));
  }
  [[nodiscard]] bool Is(ValueToken::Kind kind) const noexcept { return token_->kind == kind; }
  [[nodiscard]] bool IsWord(std::string_view word) const noexcept {
    return Is(ValueToken::Kind::kWord) && token_->text == word;
  }

  std::shared_ptr<const ValueToken> token_;  // owns all of the text's
};

/// Takes members out of an object one after the other. What is missing or of a wrong kind is remembered, the
/// first of it, so that readers read straight on. A member that is null is as good as none.
class JsonMembers {
 public:
  explicit JsonMembers(const JsonPart& object) : members_(object.members()) {}

  /// Null or not; nullptr if there is none.
  const JsonPart* Find(const std::string& name);

  std::optional<std::string> Text(const std::string& name);
  /// Finite, and not below 0.
  std::optional<double> Number(const std::string& name);
  std::optional<std::uint64_t> Count(const std::string& name, std::uint64_t most);
  std::optional<bool> Flag(const std::string& name);
  std::optional<std::vector<JsonPart>> List(const std::string& name);

  // It is an error if there is none.
  std::string NeedText(const std::string& name) { return Needed(name, Text(name)); }
  std::uint64_t NeedCount(const std::string& name, std::uint64_t most) { return Needed(name, Count(name, most)); }
  std::vector<JsonPart> NeedList(const std::string& name) { return Needed(name, List(name)); }
  std::vector<std::string> NeedTexts(const std::string& name);

  void Complain(std::string message, std::string hint = {}) {
    if (!error_) error_ = Error{.message = std::move(message), .hint = std::move(hint)};
  }
  /// Complains of members that nobody has asked for.
  void RefuseOthers();
  [[nodiscard]] const std::optional<Error>& error() const noexcept { return error_; }

 private:
  template <typename Get>
  auto Take(const std::string& name, const std::string& what, const Get& get)
      -> decltype(get(std::declval<const JsonPart&>()));
  template <typename T>
  T Needed(const std::string& name, std::optional<T> found) {
    if (!found) Complain("\"" + name + "\" is missing");
    return found ? std::move(*found) : T();
  }

  const std::vector<std::pair<std::string, JsonPart>> members_;
  std::vector<std::string> known_;
  std::optional<Error> error_;
};

}  // namespace runnel
