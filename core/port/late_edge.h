#pragma once

namespace runnel {

class Port;

/// Whether values come one cycle late by the connection of the two (ConnectOptions::late), so that it does not
/// say which of their modules runs first. False if they are not connected. Quick as long as no connection of
/// the process is late. Under the structure lock.
[[nodiscard]] bool IsLate(const Port& from, const Port& to);

}  // namespace runnel
