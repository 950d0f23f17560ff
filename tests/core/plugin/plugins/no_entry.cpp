// A shared library like any other.
extern "C" __attribute__((visibility("default"))) int Unrelated();
int Unrelated() { return 1; }
