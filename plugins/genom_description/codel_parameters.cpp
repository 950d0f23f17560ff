// How a parameter of a codel, or of an attribute, finds its data.

#include <algorithm>

#include "core/base/nearest_name.h"
#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

namespace {

using Source = ParameterSource;

std::vector<std::string> NamesIn(const Component& component, Source source, const std::vector<Parameter>& locals) {
  std::vector<std::string> names;
  const auto add = [&](const std::vector<std::string>& more) { names.insert(names.end(), more.begin(), more.end()); };
  const bool is_any = source == Source::kNone;
  if ((is_any || source == Source::kIds) && component.ids != nullptr) add(NamesOf(component.ids->members, &Type::name));
  if (is_any || source == Source::kLocal) add(NamesOf(locals, &Parameter::name));
  if (is_any || source == Source::kPort) add(NamesOf(component.ports, &Port::name));
  if (is_any || source == Source::kRemote) add(NamesOf(component.remotes, &Remote::name));
  return names;
}

}  // namespace

bool ComponentRules::FollowPath(Parameter& parameter, Type* type, std::size_t from) {
  for (std::size_t i = from; i < parameter.path.size(); ++i) {
    const PathStep& step = parameter.path[i];
    if (FinalType(type)->Is(TypeKind::kInvalid)) break;
    if (!step.member.empty()) {
      Type* member = MemberOf(type, step.member);
      if (member == nullptr) {
        const Type* final_type = FinalType(type);
        while (final_type->Is(TypeKind::kOptional)) final_type = FinalType(final_type->type);
        problems_.Add(parameter.place, KindAndName(*type) + " has no member '" + step.member + "'",
                      NearestNameHint(step.member, NamesOf(final_type->members, &Type::name)));
        return false;
      }
      type = member->type;
      continue;
    }
    const Type* array = ElementOf(type);
    if (array == nullptr) {
      problems_.Add(parameter.place, KindAndName(*type) + " has no elements");
      return false;
    }
    if (step.index >= array->length) {
      problems_.Add(parameter.place,
                    "element " + std::to_string(step.index) + " is beyond the end of " + array->ShownName());
      return false;
    }
    type = array->type;
  }
  parameter.type = type;
  return true;
}

bool ComponentRules::Resolve(Parameter& parameter, const std::vector<Parameter>& locals) {
  const std::string first = parameter.path.empty() ? "" : parameter.path[0].member;
  Component& component = *current_;
  Type* ids_member = component.ids == nullptr ? nullptr : MemberOf(component.ids, first);
  const Parameter* local = FindParameter(locals, first);
  Port* port = FindByName(component.ports, first);
  Remote* remote = FindByName(component.remotes, first);
  if (parameter.source == Source::kNone) {
    const int candidates = (ids_member != nullptr) + (local != nullptr) + (port != nullptr) + (remote != nullptr);
    if (candidates > 1) {
      problems_.Add(parameter.place,
                    "'" + first + "' is in more than one place: it can be " +
                        std::string(ids_member != nullptr ? "ids, " : "") + (local != nullptr ? "local, " : "") +
                        (port != nullptr ? "port, " : "") + (remote != nullptr ? "remote, " : "") +
                        "and nothing says which",
                    "say from where it is: ids, local, port or remote before its direction");
      return false;
    }
    parameter.source = parameter.path.empty() || ids_member != nullptr ? Source::kIds
                       : local != nullptr                              ? Source::kLocal
                       : port != nullptr                               ? Source::kPort
                       : remote != nullptr                             ? Source::kRemote
                                                                       : Source::kNone;
  }
  const auto tell_unknown = [&]() {
    problems_.Add(
        parameter.place,
        "there is no '" + first + "' " +
            (parameter.source == Source::kNone ? "in the ids, and no parameter, variable, port or remote of that name"
                                               : "among what is " + std::string(NameOf(parameter.source))),
        "it must be declared before; " + NearestNameHint(first, NamesIn(component, parameter.source, locals)));
    return false;
  };
  if (parameter.source != Source::kIds && parameter.source != Source::kNone && parameter.path.empty()) {
    problems_.Add(parameter.place, "only the ids can be taken as a whole");
    return false;
  }
  switch (parameter.source) {
    case Source::kNone:
      return tell_unknown();
    case Source::kIds:
      if (component.ids == nullptr) {
        problems_.Add(parameter.place, "'" + component.name + "' has no ids until here", "declare them: ids { … };");
        return false;
      }
      if (!parameter.path.empty() && ids_member == nullptr) return tell_unknown();
      return FollowPath(parameter, component.ids, 0);
    case Source::kLocal:
      return local == nullptr ? tell_unknown() : FollowPath(parameter, local->type, 1);
    case Source::kPort:
    case Source::kRemote:
      break;
  }
  const bool is_port = parameter.source == Source::kPort;
  if (is_port ? port == nullptr : remote == nullptr) return tell_unknown();
  if (parameter.path.size() > 1) {
    problems_.Add(parameter.place, std::string(NameOf(parameter.source)) + " '" + first + "' is only taken as a whole");
    return false;
  }
  if (is_port && port->is_input && parameter.direction != Direction::kIn) {
    problems_.Add(parameter.place, "'" + first + "' is an input: nothing can be written to it",
                  "take it as: in " + first);
    return false;
  }
  if (!is_port && parameter.direction != Direction::kIn) {
    problems_.Add(parameter.place, "remote '" + first + "' can only be called", "take it as: in " + first);
    return false;
  }
  parameter.port = is_port ? port : nullptr;
  parameter.remote = is_port ? nullptr : remote;
  parameter.type = is_port ? port->entry : remote->entry;
  return true;
}

Codel* ComponentRules::MakeCodel(Codel codel) {
  const auto before = codels_.find(codel.name);
  if (before != codels_.end()) {
    const Codel& other = *before->second;
    const bool is_same =
        std::ranges::equal(codel.parameters, other.parameters, [](const Parameter& a, const Parameter& b) {
          if (a.port != nullptr || b.port != nullptr || a.remote || b.remote) {
            return a.direction == b.direction && a.type->full_name == b.type->full_name;
          }
          return a.direction == b.direction && AreSame(a.type, b.type);
        });
    if (!is_same) {
      problems_.Add(codel.place, "codel '" + codel.name + "' has other parameters elsewhere",
                    "a function has one signature; " + problems_.DeclaredAt(other.place));
      return nullptr;
    }
  }
  codel.component = current_;
  return &description_.codels.emplace_back(std::move(codel));
}

}  // namespace runnel::genom
