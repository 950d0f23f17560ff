#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/genom_description/component_rules.h"
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

/// Reads the tokens of a description by recursive descent. After a mistake it goes on behind the next ';', so that
/// several are told at once.
class Parser {
 public:
  Parser(std::vector<Token> tokens, Description& description);

  void Parse();

 private:
  // parse_types.cpp
  bool TypeStatement();
  void ConstantDeclaration();
  void TypedefDeclaration();
  void NativeDeclaration();
  void ExceptionDeclaration();
  Type* TypeSpecification();  // nullptr: told
  Type* ConstructedType();
  Type* SimpleType(bool may_be_forward = false);
  Type* BaseType();  // nullptr: the next token begins none
  Type* Sequence();
  Type* Optional();
  Type* String();
  Type* NamedType();
  Type* Struct();
  Type* Union();
  Type* Enum();
  Type* SwitchType();
  void UnionCase(std::vector<Type*>& cases);
  bool CaseLabel(std::vector<Constant>& labels);
  void CheckLabels(Type& new_union);
  void Members(std::vector<Type*>* members);
  void Member(std::vector<Type*>* members);
  struct Declarator {
    Token name;
    std::vector<std::uint64_t> sizes;
  };
  Declarator ReadDeclarator(std::string_view of);
  Type* WithSizes(Type* type, const Declarator& declarator);
  Type* Finished(Scope* scope, TypeKind kind, const Token& name, std::vector<Type*> members, Type* switch_type);
  std::string ScopedName();

  // parse_expressions.cpp
  Constant Expression();
  Constant BinaryExpression(int binding);
  /// After a mistake there, 1.
  Constant ValueOf(Computed result, Place place);
  Constant UnaryExpression();
  Constant PrimaryExpression();
  Constant NamedConstant();
  std::uint64_t Size();
  std::string Text();
  std::vector<std::string> TextList(std::vector<Place>* places = nullptr);
  Initializer ReadInitializer();
  void InitialValue(Initializer& initial);
  void InitialParts(Initializer& initial);

  // parse_components.cpp
  void Statement();
  void Module();
  void ComponentDeclaration(bool is_interface);
  void Item();
  void Ids();
  void TaskDeclaration();
  void PortDeclaration();
  void Pragma(const Token& token);

  void ServiceDeclaration(ServiceKind kind);
  bool AttributeParameter(Service& draft);
  bool ServiceParameter(Service& draft);
  bool AddLocal(Service& draft, Parameter parameter);
  void LocalVariables(Service& draft);
  Direction ReadDirection();
  std::vector<PathStep> ReadPath();

  // parse_properties.cpp
  /// Reads what is between { and }; `draft` is the service that it belongs to, if it does.
  void PropertyBlock(Properties& into, PropertyOwner owner, Service* draft);
  bool ReadProperty(Property& property, Service* draft);  // false: told
  bool IsProperty();
  bool TaskProperty(Property& property);
  bool TimeProperty(Property& property);
  bool ThrowProperty(Property& property);
  void InterfacesProperty(Property& property);
  void NamesProperty(Property& property);
  double TimeUnit();
  bool CodelProperty(Property& property, bool is_async, bool is_validate, Service* draft);
  bool ReadCodel(Codel& codel, Service* draft);
  bool Events(std::vector<Type*>& events, bool are_states);
  bool CodelParameter(Codel& codel, const Service* of);

  Description& description_;
  Problems& problems_;
  Scopes& scopes_;
  ComponentRules rules_;
  TokenReader reader_;
  int angles_ = 0;  // how many '<' of types are open
};

}  // namespace runnel::genom
