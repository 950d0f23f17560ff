#!/usr/bin/env python3
"""Makes fifteen districts of the folders of `plugins`:  redo.py ROOT [--no-commit-check]

ROOT is a clean clone of any commit of main before the districts. What is moved where stands in files/former_folders.txt, who
may know whom in files/layers.txt, both of which become part of the tree. Everything is driven by these two and by what the tree
has; nothing by line numbers. What does not fit is told, and the exit status is 1: with the tree as far as it got, to look at.
"""
import collections
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
FILES = os.path.join(HERE, 'files')
TOPS = ('core', 'plugins', 'modules', 'apps', 'tests', 'bench')
# As they were written; never changed by a rule.
KEPT = {'CHANGELOG.md', 'LICENSE', '.git-blame-ignore-revs'}
BINARY = ('.png', '.ico', '.mcap', '.gz', '.zst', '.bin')
# Where a path that begins with ../ is one from the file's own folder.
RELATIVE = ('.md', '.txt', '.cmake', '.js', '.mjs', '.css', '.html', '.gen', '.lua', '.py', '.idl', '.in', '.json')

problems, notes = [], collections.defaultdict(list)


def Problem(text):
    problems.append(text)


def Note(kind, text):
    notes[kind].append(text)


def Git(*words):
    return subprocess.run(['git', *words], check=True, capture_output=True, text=True).stdout


def Tracked():
    return [name for name in Git('ls-files', '-z').split('\0') if name]


def Read(name):
    with open(name, encoding='utf-8', newline='') as stream:
        return stream.read()


def Write(name, text):
    if os.path.dirname(name):
        os.makedirs(os.path.dirname(name), exist_ok=True)
    with open(name, 'w', encoding='utf-8', newline='') as stream:
        stream.write(text)


# ---- what goes where

class Moves:
    """Paths of before to paths of after."""

    def __init__(self, lines):
        self.folders, self.stems = {}, {}
        for line in lines:
            words = line.split()
            if not words or line.startswith('#'):
                continue
            if len(words) > 2:
                for stem in words[2:]:
                    self.stems[words[0], stem] = words[1]
            else:
                self.folders[words[0]] = words[1]

    def New(self, path):
        """The path after, of a path from the root before; the same where nothing moves."""
        head = ''
        rest = path
        if rest.startswith('tests/plugins/'):
            head, rest = 'tests/', rest[len('tests/'):]
        if not rest.startswith('plugins/'):
            return path
        parts = rest.split('/')
        room = parts[1]
        if len(parts) > 2 and not head:
            stem = re.split(r'\.', parts[2])[0]
            if len(parts) == 3 and (room, stem) in self.stems:
                return 'plugins/' + self.stems[room, stem] + '/' + parts[2]
        if room not in self.folders:
            return path
        return head + '/'.join(['plugins', self.folders[room], *parts[2:]])


def MoveFolders(moves):
    districts = {to.split('/')[0] for to in moves.folders.values()}
    for top in ('plugins', 'tests/plugins'):
        there = {name for name in os.listdir(top) if os.path.isdir(os.path.join(top, name))}
        flat = {name for name in there if name in FlatDistricts()}
        for name in sorted(there - set(moves.folders) - flat):
            Problem(f'{top}/{name}: goes nowhere; say where in files/former_folders.txt, and what it may know in files/layers.txt')
        Git('mv', top, top + '.before')
        os.makedirs(top)
        for name in sorted(os.listdir(top + '.before')):
            source = os.path.join(top + '.before', name)
            target = os.path.join(top, moves.folders.get(name, name) if os.path.isdir(source) else name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            os.rename(source, target)
        os.rmdir(top + '.before')
        if top == 'plugins':
            for (room, stem), to in moves.stems.items():
                folder = os.path.join(top, moves.folders[room])
                files = [name for name in os.listdir(folder) if name.split('.')[0] == stem]
                if not files:
                    Note('of former_folders.txt, not there any more', f'{room}/{stem}')
                for name in files:
                    os.makedirs(os.path.join(top, to), exist_ok=True)
                    os.rename(os.path.join(folder, name), os.path.join(top, to, name))
    for room in sorted(moves.folders):
        if not os.path.isdir(os.path.join('plugins', moves.folders[room])):
            Note('of former_folders.txt, not there any more', room)
    Git('add', '-A', 'plugins', 'tests/plugins')
    return districts


def FlatDistricts():
    return {line.split()[0] for line in LayerLines() if '/' not in line.split()[0]} - set(TOPS)


def LayerLines():
    lines = []
    for line in Read(os.path.join(FILES, 'layers.txt')).splitlines():
        text = re.sub(r'^\+ ', '  ', line).strip()
        if text and not text.startswith('#'):
            lines.append(text)
    return lines


# ---- paths within files

class Paths:
    def __init__(self, moves, files):
        self.moves = moves
        self.files = set(files)
        self.folders = set()
        for name in files:
            while '/' in name:
                name = name.rsplit('/', 1)[0]
                self.folders.add(name)
        rooms = '|'.join(sorted({*moves.folders}, key=len, reverse=True))
        self.rooted = re.compile(rf'plugins/(?P<room>{rooms})(?![\w-])(?P<rest>(?:/[\w.-]+)*/?)')
        relative = (r'(?:(?<![\w/.}])|(?<=\$\{CMAKE_CURRENT_LIST_DIR\}/)|(?<=\$\{CMAKE_CURRENT_SOURCE_DIR\}/))'
                                   r'(?:\.\./)+[\w.-]+(?:/[\w.-]+)*')
        # pathlib and std::filesystem
        self.joined = re.compile(rf'(["\'])plugins\1(\s*[/,]\s*)(["\'])({rooms})\3')
        self.either = re.compile(f'(?P<relative>{relative})|{self.rooted.pattern}')

    def Exists(self, path):
        return path in self.files or path in self.folders or path == '.'

    def Rewrite(self, name, text):
        """The text of the file that was `name`."""
        new_name = self.moves.New(name)
        text = self.joined.sub(lambda match: f'{match[1]}plugins{match[1]}{match[2]}' + match[2].join(
            match[3] + part + match[3] for part in self.moves.folders[match[4]].split('/')), text)
        if not name.endswith(RELATIVE) and 'CMakeLists' not in name:
            return self.rooted.sub(lambda match: self.Rooted(name, match), text)

        def Either(match):
            if not match['relative']:
                return self.Rooted(name, match)
            found = self.Relative(name, new_name, match['relative'])
            return found or self.rooted.sub(lambda within: self.Rooted(name, within), match['relative'])
        return self.either.sub(Either, text)

    def Relative(self, name, new_name, word):
        """The path from where the file is now; nothing where it leads nowhere."""
        dots = len(word) - len(word.rstrip('.'))
        word, tail = (word[:-dots], word[-dots:]) if dots and not word.endswith('..') else (word, '')
        target = os.path.normpath(os.path.join(os.path.dirname(name), word))
        if not self.Exists(target):
            if new_name != name and name.endswith(('.md', '.txt', '.cmake', '.mjs', '.js')):
                Note('relative paths in what has moved that lead nowhere', f'{new_name}: {word}')
            return ''
        new = os.path.relpath(self.moves.New(target), os.path.dirname(new_name) or '.')
        return new + ('/' if word.endswith('/') else '') + tail

    def Rooted(self, name, match):
        before = match.string[max(0, match.start() - 40):match.start()]
        room, rest = match['room'], match['rest']
        whole = match.group(0)
        if re.search(r'[\w-]\Z', before):
            return whole
        if before.endswith('bench/'):
            return whole
        if before.endswith('runnel/') and not before.endswith('<runnel/'):
            return whole  # lib/runnel/plugins: libraries
        if re.match(r'\.(so|manifest|extension)\b', match.string[match.end():]) or re.search(r'\.so$', rest):
            return whole
        tail = ''
        stripped = rest.rstrip('./')
        rest, tail = stripped, rest[len(stripped):]
        head = 'tests/' if before.endswith('tests/') else ''
        path = head + 'plugins/' + room + rest
        beside = os.path.normpath(os.path.join(os.path.dirname(name), 'plugins', room + rest))
        if not self.Exists(path) and rest and self.Exists(beside):
            return whole
        if rest and not self.Exists(path) and not name.startswith('tests/architecture/'):
            Note('paths that led nowhere before; their folder is renamed', f'{self.moves.New(name)}: {path}')
        return self.moves.New(path)[len(head):] + tail


INCLUDE = re.compile(r'^#include "([^"]+)"')


def SortIncludes(before, after):
    """Blocks of includes that were sorted are sorted again."""
    old, new = before.split('\n'), after.split('\n')
    if len(old) != len(new):
        raise RuntimeError('lines have come or gone')
    touched = []
    begin = 0
    while begin < len(new):
        end = begin
        while end < len(new) and INCLUDE.match(new[end]):
            end += 1
        if end > begin and old[begin:end] != new[begin:end]:
            was = [INCLUDE.match(line)[1] for line in old[begin:end]]
            if was == sorted(was):
                new[begin:end] = sorted(new[begin:end], key=lambda line: INCLUDE.match(line)[1])
            elif len(was) > 1:
                touched.append(begin + 1)
        begin = max(end, begin + 1)
    return '\n'.join(new), touched


def WrapComments(before, after):
    """Comments that have become too long go on in a line of their own."""
    lines = []
    for old, new in zip(before.split('\n'), after.split('\n')):
        comment = re.match(r'( *///?<? ).', new)
        if old == new or len(new) <= 120 or not comment:
            lines.append(new)
            continue
        at = new.rindex(' ', len(comment[1]), 120)
        lines += [new[:at], comment[1].replace('<', '') + new[at + 1:]]
    return '\n'.join(lines)


def RewriteAll(paths, moves, before):
    count = collections.Counter()
    aligned, long_lines = [], []
    for name in before:
        if name in KEPT or name.endswith(BINARY) or os.path.basename(name) == 'package-lock.json':
            continue
        new_name = moves.New(name)
        if os.path.islink(new_name) or not os.path.isfile(new_name):
            continue
        try:
            text = Read(new_name)
        except UnicodeDecodeError:
            continue
        after = paths.Rewrite(name, text)
        if after == text:
            continue
        if name.endswith(('.h', '.cpp')):
            count['includes'] += sum(a != b for a, b in zip(text.split('\n'), after.split('\n')) if INCLUDE.match(a))
            after, unsorted = SortIncludes(text, after)
            for line in unsorted:
                Note('blocks of includes that were not sorted, and are left so', f'{new_name}:{line}')
            for number, (a, b) in enumerate(zip(text.split('\n'), after.split('\n')), 1):
                if len(b) > 120 and len(a) <= 120 and name != 'tests/architecture/project_rules.cpp':
                    long_lines.append((new_name, b))
            after = WrapComments(text, after)
            if re.search(r'^#include "plugins/[^"]*" +//', after, re.M):
                aligned.append(new_name)
        count['files'] += 1
        Write(new_name, after)
    return count, aligned, long_lines


# ---- single edits

def Pattern(text):
    """The text, whatever blanks and line ends are between its words."""
    tokens = re.findall(r'\w+|[^\w\s]', re.sub(r'\n\s*///?<?', '\n', text))
    return re.compile(r'\s*(?:\n\s*///?<?\s*)?'.join(re.escape(token) for token in tokens))


def Edit(name, old, new):
    """Replaces what stands once in the file."""
    if not os.path.isfile(name):
        Problem(f'{name}: is not there to be edited')
        return
    text = Read(name)
    found = list(Pattern(old).finditer(text))
    if len(found) != 1:
        Problem(f'{name}: {len(found)} times instead of once: {old.strip().splitlines()[0]} …')
        return
    Write(name, text[:found[0].start()] + new + text[found[0].end():])


def Copy(name, to, fill=None):
    text = Read(os.path.join(FILES, name))
    Write(to, fill(text) if fill else text)


# ---- the layers, as the tests of the tree read them

class Layers:
    def __init__(self):
        self.rules = []  # (files, [what it may include])
        for line in LayerLines():
            words = line.split()
            known = []
            for word in words[1:]:
                if word.endswith('+'):
                    name = self.Whole(word[:-1])
                    rule = [rule for rule in self.rules if rule[0] == name]
                    if not rule:
                        Problem(f'layers.txt: {words[0]}: {word} does not stand above')
                        continue
                    known += [name, *rule[0][1]]
                else:
                    known.append(self.Whole(word))
            self.rules.append((self.Whole(words[0]), known))

    @staticmethod
    def Whole(name):
        return name if name.split('/')[0] in TOPS else 'plugins/' + name

    def RuleOf(self, file):
        best = None
        for index, (files, _) in enumerate(self.rules):
            fits = file.startswith(files) if files.endswith('_') else file == files or file.startswith(files + '/')
            if fits and (best is None or len(files) > len(self.rules[best][0])):
                best = index
        return best

    def May(self, rule, target):
        other = self.RuleOf(target)
        if other == rule:
            return True
        return other is not None and other < rule and any(
            target == name or target.startswith(name + '/') for name in self.rules[rule][1])

    def Districts(self):
        found = []
        for files, _ in self.rules:
            if files.startswith('plugins/') and files.split('/')[1] not in found:
                found.append(files.split('/')[1])
        return found

    def Picture(self):
        """As PlanPicture() in tests/architecture/plan_picture.cpp."""
        district = lambda name: name.split('/')[1] if name.startswith('plugins/') else ''
        below = collections.defaultdict(set)
        for files, known in self.rules:
            for name in known:
                if district(files) and district(name) not in ('', district(files)):
                    below[district(files)] |= {district(name)} | below[district(name)]
        floors, house, arrows = {}, collections.defaultdict(list), ''
        for each in self.Districts():
            others = [other for other in self.Districts() if other in below[each]]
            direct = [other for other in others if not any(other in below[between] for between in below[each])]
            floors[each] = 1 + max([floors[other] for other in others], default=0)
            house[floors[each]].append(each)
            arrows = each.ljust(12) + ' on ' + (', '.join(direct) or 'core') + '\n' + arrows
        picture = ''.join(f'{floor} │ ' + ' │ '.join(house[floor]) + '\n' for floor in sorted(house, reverse=True))
        return picture + '0 │ core\n\n' + arrows


def CheckTree(layers, moves, before):
    """Each include is there and allowed; each path in a text leads somewhere; no former path is left."""
    tracked = Tracked()
    files = set(tracked)
    folders = {name.rsplit('/', 1)[0] for name in files}
    for folder in list(folders):
        while '/' in folder:
            folder = folder.rsplit('/', 1)[0]
            folders.add(folder)
    count = 0
    include = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<(?:<%= prefix %>|runnel/)((?:core|plugins|modules)/[^>]+)>)', re.M)
    used = collections.defaultdict(set)
    for name in tracked:
        if name.endswith(BINARY) or name in KEPT:
            continue
        try:
            text = Read(name)
        except (UnicodeDecodeError, FileNotFoundError, IsADirectoryError):
            continue
        if name.endswith(('.h', '.cpp', '.inc', '.in')):
            for match in include.finditer(text):
                target = match[1] or match[2]
                if target.startswith(('gtest/', 'gmock/')) or not re.match(r'(core|plugins|modules|apps|tests|bench)/', target):
                    continue
                if name.startswith('tests/architecture/'):
                    continue  # planted
                count += 1
                if target not in files:
                    Problem(f'{name}: #include "{target}" is not there')
                elif name.endswith(('.h', '.cpp')):
                    rule = layers.RuleOf(name)
                    if rule is None:
                        Problem(f'{name}: no line of layers.txt is about it')
                    elif not layers.May(rule, target):
                        Problem(f'{name}: layers.txt does not let it include "{target}"')
                    used[layers.rules[rule or 0][0]].add(target)
        if name.endswith('.md') and not name.startswith('apps/documentation/pages/'):  # which refer to what is made
            for match in re.finditer(r'\]\(([^)#:\s]+)(?:#[^)]*)?\)', text):
                target = os.path.normpath(os.path.join(os.path.dirname(name), match[1]))
                if target not in files and target not in folders:
                    Problem(f'{name}: link to {match[1]} leads nowhere')
        for match in re.finditer(r'(?<![\w-])(?<!bench/)(?<!runnel/)(?:tests/)?plugins/[\w.-]+(?:/[\w.-]+)*', text):
            path = match[0].rstrip('.')
            beside = os.path.normpath(os.path.join(os.path.dirname(name), path))
            if name.startswith('tests/architecture/') or path.endswith('.so') or path == 'plugins/all' or path in files or path in folders or beside in files or beside in folders:
                continue
            Note('paths below plugins that lead nowhere', f'{name}: {path}')
    for files_, known in layers.rules:
        if files_ not in folders and files_ not in files and not (files_.endswith('_') and any(name.startswith(files_) for name in files)):
            Problem(f'layers.txt: {files_}: is not there')
        parts = files_.split('/')
        if parts[0] == 'plugins' and len(parts) == 3 and f'`{parts[2]}`' not in Read('/'.join(parts[:2]) + '/README.md'):
            Problem(f'plugins/{parts[1]}/README.md: does not name the room {parts[2]}')
        for name in known:
            if name not in files and name not in folders:
                Problem(f'layers.txt: {files_}: {name} is not there')
            elif files_ in used and files_.startswith(('plugins/', 'modules/')) and '/' in name.replace('plugins/', '', 1) and \
                    not any(target == name or target.startswith(name + '/') for target in used[files_]):
                Note('of layers.txt, not used', f'{files_}: {name}')
    return count


# ---- the one-off parts

def BuildFiles():
    Copy('layers.txt', 'layers.txt')
    Copy('former_folders.txt', 'plugins/former_folders.txt')
    Copy('RunnelLayers.cmake', 'core/cmake/RunnelLayers.cmake')
    Write('plugins/CMakeLists.txt',
          'set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME librunnel)  # the package, see apps/packages\n'
          'runnel_add_layers(plugins)\n')
    Write('tests/plugins/CMakeLists.txt', 'runnel_add_layers(plugins)\n')
    text = Read('core/CMakeLists.txt')
    kept = [line for line in text.splitlines() if not line.startswith(('#', 'add_subdirectory'))]
    Write('core/CMakeLists.txt', '\n'.join([line for line in kept if line] + ['runnel_add_layers(core)', '']))
    text = Read('modules/CMakeLists.txt')
    if re.sub(r'add_subdirectory\(\w+\)|if\(RUNNEL_SLIM\)\s*return\(\)\s*endif\(\)|\s', '', text):
        Problem('modules/CMakeLists.txt: has more in it than folders')
    folders = set(re.findall(r'add_subdirectory\((\w+)\)', text))
    known = {line.split()[0].split('/')[1] for line in LayerLines() if line.startswith('modules/')}
    for folder in sorted(folders - known):
        Problem(f'modules/{folder}: is not in layers.txt')
    Write('modules/CMakeLists.txt', 'runnel_add_layers(modules)\n')
    named = {Layers.Whole(line.split()[0]) for line in LayerLines()}
    for name in Git('ls-files', 'core/*/CMakeLists.txt', 'plugins/*/CMakeLists.txt', 'modules/*/CMakeLists.txt').split():
        folder = os.path.dirname(name)
        if os.path.isfile(name) and folder not in named and os.path.dirname(folder) not in named:
            Problem(f'{folder}: is not in layers.txt, so it is not built')

    Edit('CMakeLists.txt', 'include(RunnelTargets)', 'include(RunnelTargets)\ninclude(RunnelLayers)')
    Edit('CMakeLists.txt', '# Layers, bottom to top: each may use what stands above it in this list, never what stands below.',
         '# Bottom to top; what may use what is said in layers.txt.')
    Edit('CMakeLists.txt', 'add_subdirectory(apps)', 'add_subdirectory(apps)\nrunnel_check_layers()')

    # It includes nothing of it.
    name = 'plugins/network/discovery/CMakeLists.txt'
    Write(name, re.sub(r' runnel::values(?=[\s)])', '', Read(name)))
    # What stood in the list of folders beside their names.
    Edit('plugins/testing/CMakeLists.txt', 'find_package(GTest REQUIRED)',
         'if(RUNNEL_SLIM AND NOT RUNNEL_BUILD_TESTS)\n  return()\nendif()\nfind_package(GTest REQUIRED)')
    name = 'plugins/viewers/inspector/CMakeLists.txt'
    Write(name, Read(name).rstrip('\n') + '\n\nadd_subdirectory(page)\n')

    Edit('core/cmake/InstallHeaders.cmake', '''
  # One that is the same stays as old as it is: what includes it need not be built again.
  set(before "")
  if(EXISTS "$ENV{DESTDIR}${installed}")
    file(READ "$ENV{DESTDIR}${installed}" before)
  endif()
  if(NOT text STREQUAL before)
    file(WRITE "$ENV{DESTDIR}${installed}" "${text}")
  endif()
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${installed}")
endforeach()''', '''install_header("${installed}" "${text}")
  # Where it was in version 0.2, one that includes it from where it is now; for one version.
  if(name MATCHES "^plugins/([^/]+/[^/]+)/(.+)$")
    set(room "${CMAKE_MATCH_1}")
    set(rest "${CMAKE_MATCH_2}")
    foreach(line IN LISTS former)
      if(line MATCHES "^([a-z_]+) +${room}( |$)")
        install_header("${destination}/plugins/${CMAKE_MATCH_1}/${rest}" "#pragma once\\n\\n#include <runnel/${name}>\\n")
        break()
      endif()
    endforeach()
  endif()
endforeach()''')
    Edit('core/cmake/InstallHeaders.cmake', 'foreach(header IN LISTS headers)', '''file(STRINGS "${root}/plugins/former_folders.txt" former REGEX "^[a-z]")

function(install_header installed text)
  # One that is the same stays as old as it is: what includes it need not be built again.
  set(before "")
  if(EXISTS "$ENV{DESTDIR}${installed}")
    file(READ "$ENV{DESTDIR}${installed}" before)
  endif()
  if(NOT text STREQUAL before)
    file(WRITE "$ENV{DESTDIR}${installed}" "${text}")
  endif()
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${installed}")
  set(CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_MANIFEST_FILES}" PARENT_SCOPE)
endfunction()

foreach(header IN LISTS headers)''')
    Edit('tests/integration/installed_package/headers.cmake', '''if(count LESS 200)''',
         '''# What was there before the districts, for one version.
foreach(header services/service.h blackboards/blackboard.h structure/structure_editor.h values/watched_port.h)
  if(NOT EXISTS "${WORK}/prefix/include/runnel/plugins/${header}")
    message(FATAL_ERROR "<runnel/plugins/${header}> is not there any more")
  endif()
endforeach()
if(count LESS 200)''')
    Edit('.ci/coverage', '''library = part[1] "/" part[2];''',
         '''library = part[1] "/" part[2]; if (part[1] == "plugins" && part[4] != "") library = library "/" part[3];''')


def ArchitectureTest():
    Copy('project_rules.cpp', 'tests/architecture/project_rules.cpp')
    for name in ('plan_picture.h', 'plan_picture.cpp', 'layers_test.cpp'):
        Copy(name, 'tests/architecture/' + name)
    Edit('tests/architecture/CMakeLists.txt', 'SOURCES include_rules.cpp include_rules_test.cpp layering_test.cpp project_rules.cpp source_rules.cpp',
         'SOURCES include_rules.cpp include_rules_test.cpp layering_test.cpp layers_test.cpp plan_picture.cpp project_rules.cpp\n    source_rules.cpp')
    name = 'tests/architecture/include_rules.h'
    Edit(name, '''/// Which files a rule is about, and which folders they may include from. A file falls under the
/// first rule whose pattern it matches.''',
         '''/// Which files a rule is about, and what they may include. A file falls under the rule with the longest
/// name that fits.''')
    Edit(name, '''std::string name;                      ///< of the part that these files are, for messages and circles
  std::string files;''', 'std::string files;')
    Edit(name, '''std::vector<std::string> may_include;  ///< folders, with all below them; their own part besides
  bool is_algorithm = false;             ///< knows no framework: of <…>, only the standard, Eigen and fmt''',
         '''std::vector<std::string> may_include = {};  ///< folders with all below them, files; what stands before it
  bool is_algorithm = false;                  ///< knows no framework: of <…>, only the standard, Eigen and fmt''')
    text = Read(name)
    Write(name, re.sub(r'(std::string files;) +(///<)', r'\1                          \2', text))
    Edit(name, '''/// The layers of the project, bottom to top.
[[nodiscard]] const std::vector<IncludeRule>& ProjectRules();''',
         '''/// What layers.txt says, bottom to top. Throws std::invalid_argument where it cannot be read.
[[nodiscard]] const std::vector<IncludeRule>& ProjectRules();

/// The rules that a text like layers.txt has.
[[nodiscard]] std::vector<IncludeRule> ReadLayers(std::string_view text);''')
    name = 'tests/architecture/include_rules.cpp'
    Edit(name, '''const auto found = std::ranges::find_if(rules, [&](const IncludeRule& rule) {
    const bool is_prefix = rule.files.ends_with('_');
    return is_prefix ? file.starts_with(rule.files) : IsAtOrBelow(file, rule.files);
  });
  return found == rules.end() ? nullptr : &*found;''',
         '''const IncludeRule* best = nullptr;
  for (const IncludeRule& rule : rules) {
    const bool is_prefix = rule.files.ends_with('_');
    const bool fits = is_prefix ? file.starts_with(rule.files) : IsAtOrBelow(file, rule.files);
    if (fits && (best == nullptr || rule.files.size() > best->files.size())) best = &rule;
  }
  return best;''')
    Edit(name, '''if (other == &rule) return "";
  const bool allowed = std::ranges::any_of(
      rule.may_include, [&](const std::string& folder) { return IsAtOrBelow(include.target, folder); });
  return allowed ? "" : rule.name + " may not know''',
         '''if (other == &rule) return "";
  const bool is_above = other != nullptr && other < &rule;  // in layers.txt
  const bool allowed = is_above && std::ranges::any_of(rule.may_include, [&](const std::string& folder) {
    return IsAtOrBelow(include.target, folder);
  });
  return allowed ? "" : rule.files + " may not know''')
    Edit(name, 'knows[from->name].insert(to->name);', 'knows[from->files].insert(to->files);')
    name = 'tests/architecture/source_tree.cpp'
    Edit(name, '''return second == std::string_view::npos ? "" : std::string(file.substr(0, second));''',
         '''if (second == std::string_view::npos) return "";
  const auto third = file.find('/', second + 1);
  const bool is_room = file.starts_with("plugins/") && third != std::string_view::npos;
  return std::string(file.substr(0, is_room ? third : second));''')
    Edit('tests/architecture/source_tree.h', '''/// The first two names of the path, "core/port" for "core/port/deep/file.h": what one
/// CMakeLists.txt makes one library of. "" if the file does not lie that deep.''',
         '''/// What one CMakeLists.txt makes libraries of: the first two names of the path, "core/port" for "core/port/deep/file.h"; in
/// `plugins` the first three, "plugins/network/wire". "" if the file does not lie that deep.''')
    name = 'tests/architecture/source_rules.cpp'
    Edit(name, '"LICENSE",', '"LICENSE", "layers.txt",')
    Edit(name, '''if (IsCode(file) && is_product && !LibraryOf(file).empty()) libraries.insert(LibraryOf(file));''',
         '''if (!IsCode(file) || !is_product || LibraryOf(file).empty()) continue;
    libraries.insert(LibraryOf(file));
    if (file.starts_with("plugins/")) libraries.insert(file.substr(0, file.find('/', std::string("plugins/").size())));''')
    Edit('tests/architecture/source_rules.h', 'Libraries (folders like core/port; not tests and bench) that have sources and no README.md.',
         'Libraries (folders like core/port; not tests and bench) and districts of plugins that have sources and no README.md.')
    Edit('tests/architecture/source_rules_test.cpp', '''{"core/cmake/tools.cmake", ""},
                           {"tests/core/a_test.cpp", ""}};
  EXPECT_THAT(LibrariesWithoutReadme(tree), ElementsAre("core/port"));''',
         '''{"core/cmake/tools.cmake", ""},
                           {"plugins/network/wire/a.h", ""},
                           {"plugins/python/plugin.cpp", ""},
                           {"tests/core/a_test.cpp", ""}};
  EXPECT_THAT(LibrariesWithoutReadme(tree),
              ElementsAre("core/port", "plugins/network", "plugins/network/wire", "plugins/python"));''')
    name = 'tests/architecture/layering_test.cpp'
    Edit(name, '#include "tests/architecture/include_rules.h"',
         '#include "tests/architecture/include_rules.h"\n#include "tests/architecture/plan_picture.h"')
    Edit(name, 'using testing::IsEmpty;', 'using testing::HasSubstr;\nusing testing::IsEmpty;')
    Edit(name, 'TEST(LayeringTest, NoLibraryIsTooLarge)', '''TEST(LayeringTest, TheReadmeOfPluginsHasThePictureOfTheLayers) {
  EXPECT_THAT(Tree().at("plugins/README.md"), HasSubstr("```\\n" + PlanPicture(ProjectRules()) + "```\\n"));
}

TEST(LayeringTest, EachDistrictSaysWhichRoomsItHas) {
  for (const IncludeRule& rule : ProjectRules()) {
    if (rule.files.ends_with('_') || rule.is_algorithm || DistrictOf(rule.files).empty()) continue;
    const std::string district = "plugins/" + DistrictOf(rule.files);
    if (rule.files == district) continue;
    EXPECT_THAT(Tree().at(district + "/README.md"), HasSubstr("`" + rule.files.substr(district.size() + 1) + "`"));
  }
}

TEST(LayeringTest, TheLayersNameWhatIsThere) {
  for (const IncludeRule& rule : ProjectRules()) {
    for (const std::string& name : rule.may_include) {
      EXPECT_TRUE(std::ranges::any_of(Tree(), [&](const auto& file) { return IsAtOrBelow(file.first, name); }))
          << rule.files << " may include " << name;
    }
  }
}

TEST(LayeringTest, NoLibraryIsTooLarge)''')
    Edit(name, '#include <gmock/gmock.h>', '#include <algorithm>\n\n#include <gmock/gmock.h>')
    # In the tests of the rules: the folder that FINROC's files were in is a room whose rules have not changed.


def SplitOffWatchedPorts():
    """Of the folder `values`: what looks at ports, and knows no JSON."""
    name = 'plugins/values/json/CMakeLists.txt'
    text = Read(name)
    found = re.search(r'(?:^#[^\n]*\n)*^runnel_library\(watched_port\b[^)]*\)\n', text, re.M)
    if not found:
        Problem(f'{name}: has no library watched_port')
        return
    Write(name, (text[:found.start()].rstrip('\n') + '\n' + text[found.end():]))
    Write('plugins/values/watched/CMakeLists.txt', found[0])
    name = 'plugins/values/json/README.md'
    text = Read(name)
    rows = re.findall(r'^\| `(?:watched_port|port_patterns)\.h` \|.*\n', text, re.M)
    section = re.search(r'^## A watched port\n.*?(?=^## )', text, re.M | re.S)
    does_not = re.findall(r'^- (?:Say how often|Show every value).*\n(?:  .*\n)*', text, re.M)
    if len(rows) != 2 or not section or len(does_not) != 2:
        Note('to look at', f'{name}: what it says of watched ports is to be moved to plugins/values/watched/README.md')
    for part in [*rows, *does_not, section[0] if section else '']:
        text = text.replace(part, '')
    Write(name, text)
    Copy('watched.md', 'plugins/values/watched/README.md', lambda page: page
         .replace('{{rows}}', ''.join(rows).rstrip('\n'))
         .replace('{{section}}', section[0].rstrip('\n') if section else ''))


def Documents(layers, old_readme):
    slim = re.search(r'^## What a slim process has\n.*', old_readme, re.M | re.S)
    if not slim:
        Problem('plugins/README.md: has no section "What a slim process has" any more; it is to be kept')
    Copy('README.md', 'plugins/README.md', lambda text: text
         .replace('{{picture}}', layers.Picture()).replace('{{slim}}', slim[0].rstrip('\n') if slim else ''))
    for district in layers.Districts():
        source = f'districts/{district}.md'
        if os.path.isfile(os.path.join(FILES, source)):
            Copy(source, f'plugins/{district}/README.md')
        elif not os.path.isfile(f'plugins/{district}/README.md'):
            Problem(f'plugins/{district}: has no README')
    Edit('CHANGELOG.md', '## Unreleased\n', '''## Unreleased

- The folders of `plugins` stand in fifteen districts (`plugins/README.md`). Headers are installed with them:
  `<runnel/plugins/services/calls/service.h>`; the paths of 0.2 (`<runnel/plugins/services/service.h>`) work for one more version.
  Targets, plugins and `<runnel/module.h>` and its like are called as before.
''')
    text = Read('CHANGELOG.md')
    Write('CHANGELOG.md', text.replace('are called as before.\n\n\n- ', 'are called as before.\n- ').replace('are called as before.\n\n- ', 'are called as before.\n- '))
    Edit('apps/headers/README.md', 'it belongs to the\nlibrary of its folder.',
         'it belongs to the\nlibrary of its folder. Those of `plugins` are for one version also where they were before the districts:\n'
         '`<runnel/plugins/structure/structure_editor.h>` (`plugins/former_folders.txt`).')
    Edit('apps/documentation/pages/how_to/cmake_targets.md',
         '''Each folder of `core`, `plugins` and `modules` is a library of its name (`core/port` is `runnel::port`), and its README
says what it has.''',
         '''Each room of `core`, `plugins` and `modules` has a library: `core/port` is `runnel::port`, `plugins/execution/scheduling` is
`runnel::scheduling`; its README says what it has.''')
    Edit('.github/CONTRIBUTING.md', '''A layer knows those below it and none above; algorithms in `modules/*/algorithm` know no framework. `test_architecture`
says so when it is not so.''',
         '''What may know what is written in [layers.txt](../layers.txt), and nowhere else; algorithms in `modules/*/algorithm` know no
framework. CMake and `test_architecture` say so when it is not so.''')


def Format(aligned, long_lines):
    """What clang-format would change of what has been changed here."""
    if not shutil.which('clang-format'):
        Problem('clang-format is not here')
        return
    for name in aligned:
        lines = Read(name).split('\n')
        numbers = [number for number, line in enumerate(lines, 1) if INCLUDE.match(line)]
        subprocess.run(['clang-format', '-i', f'--lines={numbers[0]}:{numbers[-1]}', name], check=True)
    for name in sorted({name for name, _ in long_lines}):
        lines = Read(name).split('\n')
        wanted = [line for where, line in long_lines if where == name]
        words = [f'--lines={number}:{number}' for number, line in enumerate(lines, 1) if line in wanted]
        if words:
            subprocess.run(['clang-format', '-i', *words, name], check=True)
    names = [name for name in Git('ls-files', 'tests/architecture').split() if name.endswith(('.h', '.cpp'))]
    subprocess.run(['clang-format', '-i', *names], check=True)
    for name in sorted({name for name, _ in long_lines}):
        for number, line in enumerate(Read(name).split('\n'), 1):
            if len(line) > 120:
                Note('lines that are too long', f'{name}:{number}')


def Main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    os.chdir(sys.argv[1])
    if not os.path.isdir('.git') and not os.path.isfile('.git'):
        sys.exit('not the root of a tree')
    if Git('status', '--porcelain'):
        sys.exit('the tree has changes that are not committed')
    if os.path.isdir('plugins/execution') or os.path.exists('layers.txt'):
        sys.exit('the tree has districts already')
    moves = Moves(Read(os.path.join(FILES, 'former_folders.txt')).splitlines())
    before = Tracked()
    old_readme = Read('plugins/README.md')
    known_rules = Read(os.path.join(FILES, 'known_project_rules.cpp'))
    literals = lambda text: ''.join(re.findall(r'"([^"\n]*)"', text))
    if literals(known_rules) != literals(Read('tests/architecture/project_rules.cpp')):
        Note('to look at', 'tests/architecture/project_rules.cpp is not the one that layers.txt was made of '
             '(files/known_project_rules.cpp): take over what it says beyond the includes that are there')
    MoveFolders(moves)
    paths = Paths(moves, before)
    count, aligned, long_lines = RewriteAll(paths, moves, before)
    layers = Layers()
    SplitOffWatchedPorts()
    BuildFiles()
    ArchitectureTest()
    # The README of plugins is written anew, of what it was only the part that is measured is kept.
    Documents(layers, paths.Rewrite('plugins/README.md', old_readme))
    Format(aligned, long_lines)
    Git('add', '-A')
    includes = CheckTree(layers, moves, before)
    renamed = Git('diff', '--cached', '-M50%', '--name-status', 'HEAD').splitlines()
    for kind, texts in notes.items():
        print(f'{kind}:')
        for text in sorted(set(texts)):
            print(f'  {text}')
    kinds = collections.Counter(line[0] for line in renamed)
    print(f'{kinds["R"]} files moved, {kinds["M"]} changed in place, {kinds["A"]} new, {kinds["D"]} gone; '
          f'{count["files"]} files with paths rewritten, {count["includes"]} of them includes; {includes} includes looked up')
    for problem in problems:
        print('PROBLEM', problem)
    sys.exit(1 if problems else 0)


if __name__ == '__main__':
    Main()
