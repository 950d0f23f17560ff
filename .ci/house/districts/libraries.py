#!/usr/bin/env python3
"""One librunnel.so, static rooms within extensions, after redo.py:  libraries.py ROOT

ROOT is the tree as redo.py left it (committed or staged). What does not fit is told, and the exit status is 1.
"""
import collections
import os
import re
import sys

import redo
from redo import Edit, Note, Problem, Read, Write

# Libraries that are installed as archives, for the plugins and programs that users make of them.
STATIC = {'genom_execution': 'plugins/genom/execution', 'genom_modules': 'plugins/genom/modules',
          'genom_standalone': 'plugins/genom/standalone', 'behaviours_algorithm': 'plugins/behaviours/networks',
          'flow': 'modules/flow'}
# What several plugins derive from.
SHARED = {'behaviours': 'plugins/behaviours/networks'}
# No part of what is installed any more: they depend on what is within extensions and programs.
INSIDE = {'simulation': 'modules/simulation'}


def Keyword(libraries, old, new):
    for library, folder in libraries.items():
        name = folder + '/CMakeLists.txt'
        text = Read(name)
        found = re.findall(rf'runnel_library\({library}{old}(?=\s)', text)
        if len(found) != 1:
            Problem(f'{name}: has no runnel_library({library}{old} …)')
            continue
        Write(name, re.sub(rf'runnel_library\({library}{old}(?=\s)', f'runnel_library({library}{new}', text))


def Main():
    os.chdir(sys.argv[1])
    if not os.path.isfile('layers.txt'):
        sys.exit('redo.py comes first')
    layers = Read('layers.txt')
    Edit('layers.txt', '# - `+` in front: every application has it. RUNNEL_SLIM builds nothing else.',
         '# - `+` in front: every application has it. Of `core` and `plugins` it is part of librunnel.so (core/cmake/RunnelTargets.cmake);\n'
         '#   RUNNEL_SLIM builds nothing else.')
    # Sockets of two engines are not to be opened at once, and both are found in one table: so there is one of it in a process.
    text = Read('layers.txt')
    Write('layers.txt', re.sub(r'^  (network/wire +core)$', r'+ \1', text, flags=re.M))
    if '+ network/wire ' not in Read('layers.txt'):
        Problem('layers.txt: has no line network/wire')

    name = 'core/cmake/RunnelTargets.cmake'
    text = Read(name)
    begin = text.find('# runnel_library(<name>')
    end = text.find('# runnel_write_manifest(<plugin>)')
    if begin < 0 or end < begin or text[begin:end].count('endfunction()') != 2:
        Problem(f'{name}: does not have runnel_library() and runnel_public_headers() where they were')
    else:
        Write(name, text[:begin] + Read(os.path.join(redo.FILES, 'runnel_library.cmake')) + text[end:])
    name = 'core/cmake/RunnelLayers.cmake'
    Write(name, Read(name).rstrip('\n') + '''

# runnel_is_in_every_application(<variable> <folder>): whether layers.txt has a "+" before this folder of core or plugins.
function(runnel_is_in_every_application result folder)
  set(${result} OFF PARENT_SCOPE)
  string(REGEX REPLACE "^plugins/" "" name "${folder}")
  if(folder MATCHES "^(core|plugins)/")
    file(STRINGS "${RUNNEL_ROOT}/layers.txt" lines REGEX "^\\\\+ ${name}( |$)")
    if(lines)
      set(${result} ON PARENT_SCOPE)
    endif()
  endif()
endfunction()
''')
    Edit('CMakeLists.txt', 'add_subdirectory(core)', 'runnel_main_library()\nadd_subdirectory(core)')
    for folder, library in {'plugins/execution/timing': 'timing', 'plugins/execution/scheduling': 'scheduling'}.items():
        name = folder + '/CMakeLists.txt'
        text = Read(name)
        new = re.sub(rf'(?:# Functions of this library[^\n]*\n)?target_compile_options\(runnel_{library} PRIVATE -fno-semantic-interposition\)\n',
                     '', text)
        if new == text:
            Problem(f'{name}: has no -fno-semantic-interposition')
        Write(name, new)
    Keyword(STATIC, '', ' STATIC')
    Keyword(SHARED, '', ' SHARED')
    Keyword(INSIDE, ' STATIC', '')
    name = 'plugins/diagnosis/real_time_check/CMakeLists.txt'
    Edit(name, '# Shared, since a process has one handler of its signal.',
         '# Part of librunnel.so, since a process has one handler of its signal.')

    # One table of engines in a process, wherever the network is linked.
    name = 'plugins/network/wire/wire_engines.h'
    Edit(name, 'class WireEngines final : public OfferedRegistry {\n public:',
         '''class WireEngines final : public OfferedRegistry {
 public:
  /// Of the process, as libraries are: an engine may be shared by the applications in it.
  [[nodiscard]] static WireEngines& OfProcess();
''')
    name = 'plugins/network/wire/wire.cpp'
    text = Read(name)
    Write('plugins/network/wire/wire_engines.cpp', '''#include "plugins/network/wire/wire_engines.h"

namespace runnel {

WireEngines& WireEngines::OfProcess() {
  static WireEngines engines;
  return engines;
}

}  // namespace runnel
''')
    Edit('plugins/network/wire/CMakeLists.txt', 'wire.cpp', 'wire.cpp wire_engines.cpp')
    name = 'plugins/network/ports/network_engines.cpp'
    Edit(name, '''namespace {

// Of the process, as libraries are: an engine may be shared by the applications in it.
WireEngines& Engines() {
  static WireEngines engines;
  return engines;
}

}  // namespace

''', '')
    if os.path.isfile(name):
        Write(name, Read(name).replace('Engines()', 'WireEngines::OfProcess()'))

    # What says which libraries there are.
    name = 'tests/integration/extensions_test.cpp'
    Edit(name, 'EXPECT_THAT(maps, HasSubstr("/librunnel_application.so"));', 'EXPECT_THAT(maps, HasSubstr("/librunnel.so"));')
    Edit(name, '''EXPECT_THAT(program.Maps(),
              AllOf(HasSubstr("/viewers.so"), HasSubstr("/librunnel_inspector.so"), Not(HasSubstr("mcap"))));''',
         'EXPECT_THAT(program.Maps(), AllOf(HasSubstr("/viewers.so"), Not(HasSubstr("recording.so"))));')
    Edit(name, 'ASSERT_THAT(program.Maps(), Not(HasSubstr("mcap")));', 'ASSERT_THAT(program.Maps(), Not(HasSubstr("recording.so")));')
    Edit(name, 'EXPECT_THAT(program.Maps(), HasSubstr("/librunnel_mcap.so"));', 'EXPECT_THAT(program.Maps(), HasSubstr("/recording.so"));')
    name = 'tests/packages/make'
    Edit(name, 'for library in "$root"/usr/lib/librunnel_*.so.*.*.*; do', '''count=$(ls "$root"/usr/lib/*.so.*.*.* | wc -l)
[ "$count" = 2 ] || fail "there are $count libraries instead of librunnel.so and that of behaviours"
for library in "$root"/usr/lib/librunnel*.so.*.*.*; do''')
    # Only librunnel has libraries for the loader's list now, and who builds needs no page for what linkers want.
    Edit('apps/packages/CMakeLists.txt', 'foreach(package librunnel runnel runnel-inspector)', 'foreach(package librunnel)')
    Edit('apps/packages/CMakeLists.txt', '"librunnel ${same}" "runnel ${same}" "runnel-inspector ${same}" "cmake (>= 3.25)"',
         '"librunnel ${same}" "runnel ${same}" "cmake (>= 3.25)"')
    Edit('.ci/abi', 'for old in "$1"/librunnel_*.so.*.*.*; do', 'for old in "$1"/librunnel*.so.*.*.*; do')
    Edit('bench/plugins/footprint_bench.cpp', 'name.starts_with("librunnel_")', 'name.starts_with("librunnel")')
    name = 'apps/packages/README.md'
    Edit(name, 'the libraries that every application links, and its extensions: recordings, traces, the real-time check',
         'the library that every application links, `librunnel.so`, that of behaviours, and extensions: recordings, traces, the real-time check')
    Edit(name, 'and its libraries have a name of their own: `librunnel_port.so.0.2`.', 'and its libraries have a name of their own: `librunnel.so.0.2`.')
    Edit(name, '| `librunnel-dev` | headers, and the package for CMake |', '| `librunnel-dev` | headers, archives for components of GenoM3 and for tests, and the package for CMake |')
    Edit('apps/documentation/pages/how_to/cmake_targets.md', 'Each room of `core`, `plugins` and `modules` has a library',
         'What every application has is one file, `librunnel.so`; these are names for what it has, but for `runnel::behaviours`, a library of\n'
         'its own, and for what goes into your plugin or test: `runnel::planning`, `runnel::testing`. What only extensions and programs have\n'
         'cannot be linked.\n\nEach room of `core`, `plugins` and `modules` has a library')
    Edit('plugins/README.md', '## Extensions\n', '''## Libraries

What has a "yes" in the table above is one library with the core, `librunnel.so`: `runnel::scheduling`, `runnel::values` and so on
are names for it. An extension has its own rooms in itself, a program what it needs beside: nobody else links these. Of `plugins`
only `librunnel_behaviours.so` is shared besides, since several plugins derive from what is in it, and
`librunnel_real_time_hooks.so`, which is preloaded.

## Extensions
''')
    text = Read('CHANGELOG.md')
    at = text.find('  Targets, plugins and `<runnel/module.h>` and its like are called as before.\n')
    if at < 0:
        Problem('CHANGELOG.md: has no entry of the districts')
    else:
        at = text.index('\n', at) + 1
        Write('CHANGELOG.md', text[:at] + '''- Every application links one library, `librunnel.so`, instead of up to 32: targets are called as before (`runnel::scheduling`). What is
  within extensions and programs (network, recordings, MCAP, viewers, simulation, reading descriptions of components) is no library
  of its own any more, and its headers are not installed.
''' + text[at:])

    # Which headers are installed, and whether they can do without those that are not.
    every = {redo.Layers.Whole(line.split()[1]) for line in Read('layers.txt').splitlines() if line.startswith('+ ')}
    installed, inside, libraries = set(), set(), collections.defaultdict(list)
    for name in redo.Git('ls-files', 'core', 'plugins', 'modules', '--cached', '--others').split():
        if not name.endswith('CMakeLists.txt') or not os.path.isfile(name):
            continue
        folder = os.path.dirname(name)
        for match in re.finditer(r'runnel_library\((\w+)( STATIC| SHARED)?\b([^)]*)', Read(name)):
            library, kind, body = match.groups()
            headers = re.search(r'HEADERS\s+((?:[\w./]+\.h\s*)+)', body)
            has_sources = 'SOURCES' in body
            kind = 'header-only' if not has_sources else (kind or '').strip() or (
                'part' if folder in every and folder.startswith(('core', 'plugins')) else 'inside')
            libraries[kind].append(library)
            for header in (headers[1].split() if headers else []):
                (inside if kind == 'inside' else installed).add(f'{folder}/{header}')
    for name in sorted(installed):
        for match in re.finditer(r'^#include "([^"]+)"', Read(name), re.M):
            if match[1] not in installed and not match[1].startswith('apps/headers'):
                Problem(f'{name}: is installed and includes {match[1]}, which is not')
    for kind, names in libraries.items():
        print(f'{len(names)} {kind}: {" ".join(sorted(names))}')
    print(f'{len(installed)} headers of core, plugins and modules installed, {len(inside)} not any more')

    # Tests whose program has within it what a plugin that it loads has, too.
    print('tests to look at: rooms that the program has within it, and plugins that may bring them once more')
    for name in redo.Git('ls-files', 'tests').split():
        if not name.endswith('CMakeLists.txt'):
            continue
        text = Read(name)
        for match in re.finditer(r'runnel_test\((\w+)([^)]*)\)', text):
            linked = set(re.findall(r'runnel::(\w+)', match[2])) & set(libraries['inside'])
            plugins = set(re.search(r'PLUGINS ([\w\s]+)', match[2])[1].split()) if 'PLUGINS' in match[2] else set()
            for each in re.findall(rf'add_dependencies\(test_{match[1]}\b([^)]*)\)', text):
                plugins |= set(re.findall(r'runnel_plugin(?:s\b|_(\w+))', each)) or ({'all'} if 'runnel_plugins' in each else set())
            plugins = {plugin or 'all' for plugin in plugins}
            if linked and plugins:
                print(f'  {match[1]}: {" ".join(sorted(linked))} | {" ".join(sorted(plugins))}')
    for kind, texts in redo.notes.items():
        print(f'{kind}:')
        for each in sorted(set(texts)):
            print(f'  {each}')
    for problem in redo.problems:
        print('PROBLEM', problem)
    redo.Git('add', '-A')
    sys.exit(1 if redo.problems else 0)


if __name__ == '__main__':
    Main()
