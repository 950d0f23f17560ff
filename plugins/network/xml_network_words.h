#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plugins/application_files/xml_tag.h"
#include "plugins/network/network_options.h"
#include "plugins/structure/change.h"

namespace runnel {

// The words of <offer> and <take>, which files, terminals and browsers have in common.

[[nodiscard]] std::vector<AttributeRule> OfferRules();
[[nodiscard]] std::vector<AttributeRule> TakeRules();

/// What is said under a name; "": nothing.
using SaidOf = std::function<std::string(const char* name)>;
/// All but the ports, of what has been checked by the rules.
[[nodiscard]] OfferOptions OfferSaid(const SaidOf& said);
/// What does not go together, of what each word alone allows.
[[nodiscard]] std::optional<Error> WhatIsWrong(const OfferOptions& offer);
[[nodiscard]] TakeOptions TakeSaid(const SaidOf& said);

/// The same as words, without those that are usual: what a file or a change says besides ports and topic of a take.
[[nodiscard]] std::vector<Setting> WordsOf(const OfferOptions& offer);
[[nodiscard]] std::vector<Setting> WordsOf(const TakeOptions& take);

}  // namespace runnel
