#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/genom_text/token.h"

namespace runnel::genom {

/// Thrown where the tokens fit no rule, after that has been told; caught where reading can go on. Never leaves the
/// library.
struct SyntaxError {};

/// The tokens of a description, one after the other.
class TokenReader {
 public:
  TokenReader(std::vector<Token> tokens, Problems& problems, std::function<void(const Token&)> on_pragma)
      : tokens_(std::move(tokens)), problems_(problems), on_pragma_(std::move(on_pragma)) {}

  /// The next token; pragmas before it are carried out.
  [[nodiscard]] const Token& Peek();
  [[nodiscard]] const Token& PeekSecond() const;
  Token Take();

  [[nodiscard]] bool IsMark(std::string_view mark) { return Peek().IsMark(mark); }
  [[nodiscard]] bool IsWord(std::string_view word) { return Peek().IsWord(word); }
  bool AcceptMark(std::string_view mark);
  bool AcceptWord(std::string_view word);
  void ExpectMark(std::string_view mark);
  /// A '>' that may be half of a ">>".
  void ExpectClosingAngle();
  /// A name; `of` says of what, for the message.
  Token Identifier(std::string_view of);
  [[nodiscard]] bool IsIdentifier();
  /// Tells that ';' is missing, and goes on as if it stood there.
  void Semicolon();

  /// Tells what stands in place of what was expected.
  [[noreturn]] void Fail(const std::string& expected, std::string hint = {});

  /// Moves behind the next ';' that is not within braces which open on the way, or before the '}' that closes what we
  /// are in, or to the end.
  void SkipStatement();

  /// Guards against nesting that no stack holds.
  class Depth {
   public:
    explicit Depth(TokenReader& reader);
    ~Depth() { --reader_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    TokenReader& reader_;
  };

 private:
  static constexpr int kDeepest = 150;

  std::vector<Token> tokens_;
  Problems& problems_;
  std::function<void(const Token&)> on_pragma_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Place last_ = {};
};

}  // namespace runnel::genom
