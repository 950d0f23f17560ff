// What a plugin was linked with: one library in two versions.
extern "C" int Needed() { return VERSION; }
