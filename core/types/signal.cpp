#include "core/types/signal.h"

#include <string>

namespace runnel {

void Describe(TypeBuilder<Signal>& type) {
  type.Name("signal").Leaf({.to_text = [](const void*) { return std::string("now"); },
                            .from_text = [](std::string_view text, void*) -> Result<void> {
                              if (text.empty() || text == "now" || text == "{}") return {};
                              return Error{.message = "'" + std::string(text) +
                                                      "' is no signal, which has no content",
                                           .hint = "write 'now'"};
                            },
                            .needs_quotes = false});
}

}  // namespace runnel
