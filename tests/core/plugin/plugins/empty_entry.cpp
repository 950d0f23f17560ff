extern "C" __attribute__((visibility("default"))) const void* RunnelPluginEntry();
const void* RunnelPluginEntry() { return nullptr; }
