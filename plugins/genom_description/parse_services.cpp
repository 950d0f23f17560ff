#include <algorithm>

#include "plugins/genom_description/component.h"
#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

// The name that a path gives to what it leads to.
std::string LastName(const std::vector<PathStep>& path) {
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    if (!step->member.empty()) return step->member;
  }
  return "";
}

}  // namespace

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

void Parser::AddLocal(Service& draft, Parameter parameter) {
  const auto before = std::ranges::find(draft.parameters, parameter.name, &Parameter::name);
  if (before != draft.parameters.end()) {
    problems_.Add(parameter.place, "there is a parameter '" + parameter.name + "' already",
                  problems_.DeclaredAt(before->place));
    return;
  }
  draft.parameters.push_back(std::move(parameter));
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
  const bool is_right = !parameter.initial || CheckInitializer(*parameter.initial, parameter.type, problems_);
  AddLocal(draft, std::move(parameter));
  return is_right;
}

bool Parser::ServiceParameter(Service& draft) {
  Parameter parameter{.source = ParameterSource::kLocal, .direction = ReadDirection()};
  Type* type = TypeSpecification();
  const Declarator declarator = ReadDeclarator("a parameter");
  parameter.place = declarator.name.place;
  parameter.name = declarator.name.text;
  if (reader_.AcceptMark("=")) parameter.initial = ReadInitializer();
  parameter.type = WithSizes(type != nullptr ? type : scopes_.Make(TypeKind::kInvalid, parameter.place), declarator);
  const bool is_right = !parameter.initial || CheckInitializer(*parameter.initial, parameter.type, problems_);
  AddLocal(draft, std::move(parameter));
  return is_right && type != nullptr;
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
    AddLocal(draft, std::move(variable));
  } while (reader_.AcceptMark(","));
  reader_.Semicolon();
}

}  // namespace runnel::genom
