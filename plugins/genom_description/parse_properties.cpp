#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/nearest_name.h"
#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

using Kind = PropertyKind;

struct PropertyWord {
  std::string_view text;
  Kind kind;
};
// What "local" says is no property.
constexpr std::array<PropertyWord, 31> kWords = {{{"doc", Kind::kDoc},
                                                  {"version", Kind::kVersion},
                                                  {"lang", Kind::kLanguage},
                                                  {"email", Kind::kEmail},
                                                  {"require", Kind::kRequire},
                                                  {"requires", Kind::kRequire},
                                                  {"codels-require", Kind::kCodelsRequire},
                                                  {"codels-requires", Kind::kCodelsRequire},
                                                  {"clock-rate", Kind::kClockRate},
                                                  {"provide", Kind::kProvides},
                                                  {"provides", Kind::kProvides},
                                                  {"use", Kind::kUses},
                                                  {"uses", Kind::kUses},
                                                  {"extend", Kind::kExtends},
                                                  {"extends", Kind::kExtends},
                                                  {"throw", Kind::kThrow},
                                                  {"throws", Kind::kThrow},
                                                  {"period", Kind::kPeriod},
                                                  {"delay", Kind::kDelay},
                                                  {"priority", Kind::kPriority},
                                                  {"scheduling", Kind::kScheduling},
                                                  {"stack", Kind::kStack},
                                                  {"task", Kind::kTask},
                                                  {"interrupt", Kind::kInterrupts},
                                                  {"interrupts", Kind::kInterrupts},
                                                  {"before", Kind::kBefore},
                                                  {"after", Kind::kAfter},
                                                  {"local", Kind::kCodel},
                                                  {"validate", Kind::kCodel},
                                                  {"async", Kind::kCodel},
                                                  {"codel", Kind::kCodel}}};

}  // namespace

bool Parser::IsProperty() {
  const Token& token = reader_.Peek();
  return token.kind == Token::Kind::kWord && std::ranges::find(kWords, token.text, &PropertyWord::text) != kWords.end();
}

void Parser::PropertyBlock(Properties& into, PropertyOwner owner, Service* draft) {
  reader_.ExpectMark("{");
  Scope* scope = scopes_.current();
  while (!reader_.IsMark("}")) {
    if (reader_.Peek().kind == Token::Kind::kEnd) reader_.Fail("'}'");
    try {
      if (reader_.IsWord("local") && draft != nullptr && draft->kind != ServiceKind::kAttribute) {
        reader_.Take();
        LocalVariables(*draft);
        continue;
      }
      Property property;
      if (ReadProperty(property, draft)) (void)AddProperty(into, std::move(property), owner, problems_);
    } catch (const SyntaxError&) {
      angles_ = 0;
      scopes_.Enter(scope);
      reader_.SkipStatement();
    }
  }
  reader_.Take();
}

bool Parser::ReadProperty(Property& property, Service* draft) {
  const Token word = reader_.Peek();
  property.place = word.place;
  if (!IsProperty()) {
    reader_.Fail("a property", NearestNameHint(word.text.substr(0, 50), NamesOf(kWords, &PropertyWord::text)));
  }
  if (word.text == "local") reader_.Fail("a property", "only functions and activities have variables of their own");
  reader_.Take();
  property.kind = std::ranges::find(kWords, word.text, &PropertyWord::text)->kind;
  switch (property.kind) {
    case Kind::kDoc:
    case Kind::kVersion:
    case Kind::kLanguage:
    case Kind::kEmail:
      property.text = Text();
      break;
    case Kind::kScheduling:
      if (!reader_.AcceptWord("real-time")) reader_.Fail("'real-time'");
      property.text = "real-time";
      break;
    case Kind::kRequire:
    case Kind::kCodelsRequire:
      property.texts = TextList(&property.places);
      break;
    case Kind::kPriority:
    case Kind::kStack: {
      property.number = static_cast<double>(Size());
      const bool is_stack = property.kind == Kind::kStack;
      if (is_stack && reader_.AcceptWord("k"))
        property.number *= 1024;
      else if (is_stack && reader_.AcceptWord("M"))
        property.number *= 1024.0 * 1024;
      break;
    }
    case Kind::kInterrupts:
    case Kind::kBefore:
    case Kind::kAfter:
      NamesProperty(property);
      break;
    case Kind::kProvides:
    case Kind::kUses:
    case Kind::kExtends:
      InterfacesProperty(property);
      break;
    case Kind::kClockRate:
    case Kind::kPeriod:
    case Kind::kDelay:
      return TimeProperty(property);
    case Kind::kThrow:
      return ThrowProperty(property);
    case Kind::kTask:
      return TaskProperty(property);
    case Kind::kCodel:
      if (word.text == "async" && !reader_.AcceptWord("codel")) reader_.Fail("'codel' behind 'async'");
      return CodelProperty(property, word.text == "async", word.text == "validate", draft);
  }
  reader_.Semicolon();
  return true;
}

bool Parser::TaskProperty(Property& property) {
  const Token name = reader_.Identifier("a task");
  reader_.Semicolon();
  property.task = FindByName(rules_.current()->tasks, name.text);
  if (property.task != nullptr) return true;
  problems_.Add(name.place, "there is no task '" + name.text + "' until here",
                NearestNameHint(name.text, NamesOf(rules_.current()->tasks, &Task::name)));
  return false;
}

double Parser::TimeUnit() {
  if (reader_.AcceptWord("ms")) return 1e-3;
  if (reader_.AcceptWord("us")) return 1e-6;
  (void)reader_.AcceptWord("s");
  return 1;
}

bool Parser::TimeProperty(Property& property) {
  const Place place = reader_.Peek().place;
  const Constant value = Expression();
  property.number = value.AsReal() * TimeUnit();
  reader_.Semicolon();
  if (value.is_number() && property.number >= 0 && std::isfinite(property.number)) return true;
  problems_.Add(place, value.ToText() + " is no time from 0 on");
  return false;
}

bool Parser::ThrowProperty(Property& property) {
  bool is_right = true;
  do {
    const Place place = reader_.Peek().place;
    Type* type = NamedType();
    if (type == nullptr) {
      is_right = false;
    } else if (!type->Is(TypeKind::kException)) {
      if (!type->Is(TypeKind::kInvalid)) {
        problems_.Add(place, KindAndName(*type) + " is no exception", problems_.DeclaredAt(type->place));
      }
    } else if (std::ranges::find(property.exceptions, type) != property.exceptions.end()) {
      problems_.Add(place, "exception '" + type->ShownName() + "' stands here twice");
    } else {
      property.exceptions.push_back(type);
    }
  } while (reader_.AcceptMark(","));
  reader_.Semicolon();
  return is_right;
}

void Parser::InterfacesProperty(Property& property) {
  do {
    const Token name = reader_.Identifier("an interface");
    Component* component = description_.FindComponent(name.text);
    if (component == nullptr) {
      std::vector<std::string> names;
      for (const Component& each : description_.components) {
        if (each.is_interface) names.push_back(each.name);
      }
      problems_.Add(name.place, "there is no interface '" + name.text + "' until here",
                    NearestNameHint(name.text, names));
    } else if (!component->is_interface) {
      problems_.Add(name.place, "'" + name.text + "' is a component, no interface",
                    problems_.DeclaredAt(component->place));
    } else if (std::ranges::find(property.interfaces, component) != property.interfaces.end()) {
      problems_.Add(name.place, "interface '" + name.text + "' stands here twice");
    } else {
      property.interfaces.push_back(component);
    }
  } while (reader_.AcceptMark(","));
}

void Parser::NamesProperty(Property& property) {
  do {
    const Token name = reader_.Identifier("a service");
    if (std::ranges::find(property.texts, name.text) != property.texts.end()) {
      problems_.Add(name.place, "service '" + name.text + "' stands here twice");
    }
    property.texts.push_back(name.text);
    property.places.push_back(name.place);
  } while (reader_.AcceptMark(","));
}

bool Parser::CodelProperty(Property& property, bool is_async, bool is_validate, Service* draft) {
  Codel codel{.kind = is_validate ? CodelKind::kValidate : CodelKind::kSimple, .is_async = is_async};
  const bool is_right = ReadCodel(codel, draft);
  reader_.Semicolon();
  property.codel = is_right ? rules_.MakeCodel(std::move(codel)) : nullptr;
  if (property.codel == nullptr) rules_.LeaveCodelOut();
  return property.codel != nullptr;
}

bool Parser::ReadCodel(Codel& codel, Service* draft) {
  bool is_right = true;
  if (codel.kind == CodelKind::kSimple && reader_.AcceptMark("<")) {
    codel.kind = CodelKind::kStateMachine;
    is_right = Events(codel.triggers, true);
    reader_.ExpectMark(">");
  }
  const Token name = reader_.Identifier("a codel");
  codel.name = name.text;
  codel.place = name.place;
  reader_.ExpectMark("(");
  if (!reader_.IsMark(")")) {
    do {
      is_right = CodelParameter(codel, draft) && is_right;
    } while (reader_.AcceptMark(","));
  }
  reader_.ExpectMark(")");
  if (codel.kind != CodelKind::kStateMachine) {
    if (reader_.IsWord("yield") || reader_.IsWord("yields")) {
      reader_.Fail("';'", "only a codel with a state yields: codel<start> " + codel.name);
    }
    return is_right;
  }
  if (!reader_.AcceptWord("yield") && !reader_.AcceptWord("yields")) {
    reader_.Fail("'yield'", "say what comes next: yield ether");
  }
  return Events(codel.yields, false) && is_right;
}

bool Parser::Events(std::vector<Type*>& events, bool are_states) {
  bool is_right = true;
  do {
    const Token first = reader_.Identifier("a state");
    const bool is_pause = first.text == "pause" && reader_.AcceptMark("::");
    const Token name = is_pause ? reader_.Identifier("a state") : first;
    if (is_pause && are_states) {
      problems_.Add(first.place, "a codel cannot run in 'pause::" + name.text + "'",
                    "it runs in '" + name.text + "', and another may yield pause::" + name.text);
      is_right = false;
      continue;
    }
    Type* event = rules_.Event(name, is_pause);
    if (event == nullptr) {
      is_right = false;
    } else if (std::ranges::find(events, event) != events.end()) {
      problems_.Add(name.place, "'" + name.text + "' stands here twice");
    } else {
      events.push_back(event);
    }
  } while (reader_.AcceptMark(","));
  return is_right;
}

bool Parser::CodelParameter(Codel& codel, const Service* of) {
  Parameter parameter;
  if (reader_.AcceptWord("ids"))
    parameter.source = ParameterSource::kIds;
  else if (reader_.AcceptWord("local"))
    parameter.source = ParameterSource::kLocal;
  else if (reader_.AcceptWord("port"))
    parameter.source = ParameterSource::kPort;
  else if (reader_.AcceptWord("remote"))
    parameter.source = ParameterSource::kRemote;
  parameter.direction = ReadDirection();
  parameter.place = reader_.Peek().place;
  if (!reader_.IsMark("::")) {
    parameter.path = ReadPath();
    parameter.name = LastName(parameter.path);
  }
  if (reader_.AcceptMark("::")) parameter.name = reader_.Identifier("a parameter").text;
  static const std::vector<Parameter> kNone;
  if (!rules_.Resolve(parameter, of != nullptr ? of->parameters : kNone)) return false;
  if (FindParameter(codel.parameters, parameter.name) != nullptr) {
    problems_.Add(parameter.place, "codel '" + codel.name + "' has two parameters '" + parameter.name + "'",
                  "give one another name: PATH::NAME");
    return false;
  }
  codel.parameters.push_back(std::move(parameter));
  return true;
}

}  // namespace runnel::genom
