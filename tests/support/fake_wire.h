#pragma once

#include <memory>
#include <string>

#include "plugins/wire/wire.h"

namespace runnel {

/// A network within this process: matches by topic, type and QoS as DDS does, keeps what is latched, and
/// calls back from a thread of its own, so that what runs over it is looked at by the sanitizers. Those who join one
/// engine are in one network, if of one domain.
[[nodiscard]] std::shared_ptr<WireEngine> MakeFakeWire();

/// Cuts the members of that name off from all others, who are told that their endpoints have gone, or connects them again:
/// then what a latched writer keeps is delivered again. The engines differ in whether endpoints have other handles then.
void SetCutOff(WireEngine& fake, const std::string& name, bool is_cut_off, bool gets_other_handles = true);

/// Waits until all that has been set off so far has been delivered. Not from a callback.
void WaitUntilQuiet(WireEngine& fake);

}  // namespace runnel
