#include "plugins/genom_description/component.h"
#include "plugins/genom_description/parser.h"
#include "plugins/genom_text/preprocessor.h"

namespace runnel::genom {

Parser::Parser(std::vector<Token> tokens, Description& description)
    : description_(description),
      problems_(description.problems),
      scopes_(description.scopes),
      rules_(description),
      reader_(std::move(tokens), description.problems, [this](const Token& token) { Pragma(token); }) {}

void Parser::Parse() {
  Scope* global = scopes_.current();
  while (reader_.Peek().kind != Token::Kind::kEnd) {
    try {
      Statement();
    } catch (const SyntaxError&) {
      angles_ = 0;
      if (rules_.current() != nullptr) rules_.Close();
      scopes_.Enter(global);
      reader_.SkipStatement();
      (void)reader_.AcceptMark("}");
    }
  }
}

void Parser::Statement() {
  if (reader_.IsWord("module")) {
    Module();
  } else if (reader_.IsWord("component") || reader_.IsWord("interface")) {
    ComponentDeclaration(reader_.IsWord("interface"));
  } else if (!TypeStatement()) {
    reader_.Fail("a component, an interface, a module, or the declaration of a type");
  }
}

void Parser::Module() {
  const TokenReader::Depth depth(reader_);
  reader_.Take();
  const Token name = reader_.Identifier("a module");
  Scope* around = scopes_.current();
  scopes_.EnterModule(name.text, name.place);
  reader_.ExpectMark("{");
  while (!reader_.AcceptMark("}")) {
    if (reader_.IsWord("module")) {
      Module();
    } else if (!TypeStatement()) {
      reader_.Fail("the declaration of a type, a module, or '}'");
    }
  }
  scopes_.Enter(around);
  reader_.Semicolon();
}

void Parser::ComponentDeclaration(bool is_interface) {
  reader_.Take();
  const Token name = reader_.Identifier(is_interface ? "an interface" : "a component");
  rules_.Open(name, is_interface);
  Scope* scope = scopes_.current();
  if (reader_.AcceptMark("{")) {
    while (!reader_.IsMark("}") && reader_.Peek().kind != Token::Kind::kEnd) {
      try {
        Item();
      } catch (const SyntaxError&) {
        angles_ = 0;
        scopes_.Enter(scope);
        reader_.SkipStatement();
      }
    }
    reader_.ExpectMark("}");
  }
  rules_.Close();
  reader_.Semicolon();
}

void Parser::Item() {
  if (reader_.IsWord("module")) {
    Module();
  } else if (reader_.IsWord("ids")) {
    Ids();
  } else if (reader_.IsWord("task")) {
    TaskDeclaration();
  } else if (reader_.IsWord("port")) {
    PortDeclaration();
  } else if (reader_.IsWord("attribute")) {
    ServiceDeclaration(ServiceKind::kAttribute);
  } else if (reader_.IsWord("function")) {
    ServiceDeclaration(ServiceKind::kFunction);
  } else if (reader_.IsWord("activity")) {
    ServiceDeclaration(ServiceKind::kActivity);
  } else if (IsProperty()) {
    Property property;
    if (ReadProperty(property, nullptr)) rules_.AddComponentProperty(std::move(property));
  } else if (!TypeStatement()) {
    reader_.Fail("a task, port, service, ids, a type or a property");
  }
}

void Parser::Ids() {
  reader_.Take();
  scopes_.Enter(rules_.current()->ids_scope);
  Members(nullptr);
  scopes_.Enter(rules_.current()->scope);
  reader_.Semicolon();
}

void Parser::TaskDeclaration() {
  reader_.Take();
  const Token name = reader_.Identifier("a task");
  Task draft{.place = name.place, .name = name.text, .component = rules_.current()};
  if (reader_.IsMark("{")) PropertyBlock(draft.properties, PropertyOwner::kTask, nullptr);
  reader_.Semicolon();
  rules_.AddTask(std::move(draft));
}

void Parser::PortDeclaration() {
  reader_.Take();
  Port port;
  port.is_multiple = reader_.AcceptWord("multiple");
  port.is_input = reader_.IsWord("in");
  if (!port.is_input && !reader_.IsWord("out")) reader_.Fail("'in' or 'out'", "a port is: port in TYPE NAME;");
  reader_.Take();
  port.type = TypeSpecification();
  const Token name = reader_.Identifier("a port");
  port.name = name.text;
  port.place = name.place;
  Properties properties;
  if (reader_.IsMark("{")) PropertyBlock(properties, PropertyOwner::kPort, nullptr);
  reader_.Semicolon();
  if (port.type == nullptr) {
    port.type = scopes_.Make(TypeKind::kInvalid, name.place);
    port.type->name = "?";
  }
  rules_.AddPort(std::move(port), std::move(properties));
}

void Parser::Pragma(const Token& token) {
  const std::vector<std::string> words = QuotedWords(token.text);
  const std::string& what = words[0];
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (what == "require" || what == "requires") {
    rules_.RequireForAll({.kind = PropertyKind::kRequire, .place = token.place, .texts = rest});
  } else if (what == "provide" || what == "provides") {
    for (const std::string& name : rest) {
      Component* component = description_.FindComponent(name);
      if (component == nullptr || !component->is_interface) {
        problems_.Add(token.place, "there is no interface '" + name + "'");
      } else {
        rules_.ProvideForAll(*component);
      }
    }
  } else if (what == "masquerade") {
    const std::string form = "it is: #pragma masquerade TEMPLATE TYPE TEXT";
    if (rest.size() != 3) {
      problems_.Add(token.place, "a masquerade has three words", form);
      return;
    }
    const Type* type = scopes_.Find(rest[1]);
    if (type == nullptr) {
      scopes_.TellUnknown(rest[1], token.place);
    } else if (!description_.masquerades[rest[0]].emplace(type, rest[2]).second) {
      problems_.Add(token.place, "'" + rest[1] + "' stands for something else already, for template '" + rest[0] + "'");
    }
  }
}

void Parser::ServiceDeclaration(ServiceKind kind) {
  reader_.Take();
  const Token name = reader_.Identifier(NameOf(kind));
  Service draft{.place = name.place, .name = name.text, .kind = kind, .component = rules_.current()};
  const std::size_t problems_before = problems_.count();
  reader_.ExpectMark("(");
  if (!reader_.IsMark(")")) {
    do {
      (void)(kind == ServiceKind::kAttribute ? AttributeParameter(draft) : ServiceParameter(draft));
    } while (reader_.AcceptMark(","));
  }
  reader_.ExpectMark(")");
  const bool has_right_parameters = problems_.count() == problems_before;
  if (reader_.IsMark("{")) PropertyBlock(draft.properties, OwnerOf(kind), &draft);
  reader_.Semicolon();
  if (has_right_parameters || rules_.current()->services.empty() ||
      FindByName(rules_.current()->services, name.text) == nullptr) {
    rules_.AddService(std::move(draft));
  }
}

Direction Parser::ReadDirection() {
  if (reader_.AcceptWord("in")) return Direction::kIn;
  if (reader_.AcceptWord("out")) return Direction::kOut;
  if (reader_.AcceptWord("inout")) return Direction::kInOut;
  reader_.Fail("'in', 'out' or 'inout'");
}

// "a.b[2]".
std::vector<PathStep> Parser::ReadPath() {
  std::vector<PathStep> path = {{.member = reader_.Identifier("what is meant").text}};
  while (true) {
    if (reader_.AcceptMark(".")) {
      path.push_back({.member = reader_.Identifier("a member").text});
    } else if (reader_.AcceptMark("[")) {
      path.push_back({.index = Size()});
      reader_.ExpectMark("]");
    } else {
      return path;
    }
  }
}

bool Parser::AddLocal(Service& draft, Parameter parameter) {
  const bool is_right = !parameter.initial || CheckInitializer(*parameter.initial, parameter.type, problems_);
  if (const Parameter* const before = FindParameter(draft.parameters, parameter.name)) {
    problems_.Add(parameter.place, "there is a parameter '" + parameter.name + "' already",
                  problems_.DeclaredAt(before->place));
    return is_right;
  }
  draft.parameters.push_back(std::move(parameter));
  return is_right;
}

bool Parser::AttributeParameter(Service& draft) {
  Parameter parameter{.source = ParameterSource::kIds, .direction = ReadDirection()};
  parameter.place = reader_.Peek().place;
  if (!reader_.IsMark("::")) {
    if (!reader_.IsIdentifier()) reader_.Fail("the name of something in the ids", "an attribute has no types: in NAME");
    parameter.path = ReadPath();
    parameter.name = LastName(parameter.path);
  }
  if (reader_.AcceptMark("::")) parameter.name = reader_.Identifier("a parameter").text;
  if (reader_.AcceptMark("=")) parameter.initial = ReadInitializer();
  if (!rules_.Resolve(parameter, {})) return false;
  return AddLocal(draft, std::move(parameter));
}

bool Parser::ServiceParameter(Service& draft) {
  Parameter parameter{.source = ParameterSource::kLocal, .direction = ReadDirection()};
  Type* type = TypeSpecification();
  const Declarator declarator = ReadDeclarator("a parameter");
  parameter.place = declarator.name.place;
  parameter.name = declarator.name.text;
  if (reader_.AcceptMark("=")) parameter.initial = ReadInitializer();
  parameter.type = WithSizes(type != nullptr ? type : scopes_.Make(TypeKind::kInvalid, parameter.place), declarator);
  return AddLocal(draft, std::move(parameter)) && type != nullptr;
}

void Parser::LocalVariables(Service& draft) {
  Type* type = TypeSpecification();
  do {
    const Declarator declarator = ReadDeclarator("a variable");
    Parameter variable{.place = declarator.name.place,
                       .source = ParameterSource::kLocal,
                       .is_variable = true,
                       .name = declarator.name.text};
    variable.type = WithSizes(type != nullptr ? type : scopes_.Make(TypeKind::kInvalid, variable.place), declarator);
    (void)AddLocal(draft, std::move(variable));
  } while (reader_.AcceptMark(","));
  reader_.Semicolon();
}

}  // namespace runnel::genom
