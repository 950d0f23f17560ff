#pragma once

namespace runnel {

class Runtime;

/// Lets what is offered and taken be changed while the application runs, by the changes `offer` and `take`
/// (ExtensionChanges), which can be undone. Under the structure lock.
void AddNetworkChanges(Runtime& runtime);

}  // namespace runnel
