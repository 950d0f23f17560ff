# The form of CMake files (cmake-format): a command stands on one line if it fits; else each keyword begins a line of its
# own, and what belongs to it fills lines of 120. Comments, and the case of words, stay as they are.
with section("parse"):
    additional_commands = {
        "runnel_library": {
            "pargs": 1,
            "flags": ["STATIC"],
            "kwargs": {"SOURCES": "*", "APART": "*", "HEADERS": "*", "DEPENDS": "*", "PRIVATE_DEPENDS": "*"},
        },
        "runnel_plugin": {"pargs": 1, "kwargs": {"SOURCES": "*", "DEPENDS": "*"}},
        "runnel_extension": {"pargs": 1, "kwargs": {"SOURCES": "*", "DEPENDS": "*"}},
        "runnel_bench": {"pargs": 1, "kwargs": {"SOURCES": "*", "DEPENDS": "*"}},
        "runnel_test": {
            "pargs": 1,
            "flags": ["OPTIMISED"],
            "kwargs": {"SOURCES": "*", "APART": "*", "DEPENDS": "*", "PLUGINS": "*", "LABELS": "*", "TIMEOUT": 1},
        },
        "runnel_component": {
            "pargs": 1,
            "kwargs": {"DESCRIPTION": 1, "CODELS": "*", "INCLUDES": "*", "PACKAGES": "*", "DEPENDS": "*"},
        },
        "runnel_component_sources": {
            "pargs": 2,
            "kwargs": {"DESCRIPTION": 1, "CODELS": "*", "INCLUDES": "*", "PACKAGES": "*", "DEPENDS": "*"},
        },
        "runnel_generated_component": {"pargs": 3, "kwargs": {"DESCRIPTION": 1, "INCLUDES": "*"}},
        "gtest_discover_tests": {
            "pargs": 1,
            "kwargs": {"TEST_PREFIX": 1, "DISCOVERY_TIMEOUT": 1, "PROPERTIES": {"kwargs": {"LABELS": 1, "TIMEOUT": 1}}},
        },
        "runnel_standalone": {"pargs": 1, "kwargs": {"DESCRIPTION": 1, "INCLUDES": "*", "LIBRARIES": "*"}},
    }
with section("format"):
    line_width = 120
    tab_size = 2
    max_pargs_hwrap = 1000
    max_lines_hwrap = 1000
    max_rows_cmdline = 1000
    command_case = "unchanged"
    keyword_case = "unchanged"
with section("markup"):
    enable_markup = False
