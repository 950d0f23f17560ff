#!/usr/bin/env python3
"""Applies the `auto` rows of map.tsv to a tree of Runnel's sources.

    rename.py ROOT [--check] [--format] [--map FILE ...] [--force]

ROOT is a git working tree (the folders may have been moved already). Reports what it does; changes nothing with --check, and
nothing if there are collisions. --format runs clang-format on the C++ files that were changed.

map.tsv, and map_local.tsv for names that one source file sees: old, new, kind, scope, mode, reason; separated by tabs. Only
rows whose mode is `auto` are applied.
  old, new  an identifier; a sequence of tokens (`lookout_->Ask`); `kMost*` (the star: the rest of the name, or nothing);
            for kind `file` the name of a file without its ending, which is renamed with its test (NAME_test)
  kind      js: JavaScript of the pages, and the same words as keys in C++'s strings; python: likewise; file; all others: C++,
            its templates (*.in), names in Markdown and in scripts
  scope     globs of paths, with commas; `@name`: a folder of `plugins` or `core`, or the place it has been moved to (DISTRICTS
            below), with its tests; {a,b} as in shells
A row whose scope is narrower wins over one of scope `**`.
"""
import argparse, collections, os, re, subprocess, sys

HERE = os.path.dirname(os.path.abspath(__file__))

# Where the folders of `plugins` lie after the move into districts (HOUSE, section 2). Edit it if the plan is another one.
DISTRICTS = {
    'values': 'values/json', 'cdr_values': 'values/cdr', 'services': 'services/calls', 'blackboards': 'services/blackboards',
    'timing': 'execution/timing', 'task_order': 'execution/task_order', 'scheduling': 'execution/scheduling',
    'structure': 'structure/changes', 'manifest': 'structure/manifest', 'command_service': 'control/commands',
    'control': 'control/socket', 'application': 'application/running', 'application_files': 'application/files',
    'application_tags': 'application/tags', 'supervision': 'application/supervision', 'finroc_files': 'application/finroc',
    'web_server': 'viewers/web_server', 'inspector': 'viewers/inspector', 'foxglove': 'viewers/foxglove',
    'viewers': 'viewers/extension', 'mcap': 'recording/mcap', 'recording': 'recording/recorder',
    'tracing': 'diagnosis/tracing', 'real_time_check': 'diagnosis/real_time_check', 'crash_report': 'diagnosis/crash_report',
    'wire': 'network/wire', 'wire_cyclone': 'network/cyclone', 'wire_fast': 'network/fast',
    'wire_shared_memory': 'network/shared_memory', 'network_discovery': 'network/discovery',
    'ros_messages': 'network/ros_messages', 'ros_services': 'network/ros_services', 'network': 'network/ports',
    'genom_text': 'genom/text', 'genom_description': 'genom/description', 'genom_templates': 'genom/templates',
    'genom_execution': 'genom/execution', 'genom_modules': 'genom/modules', 'genom_standalone': 'genom/standalone',
    'behaviours': 'behaviours/networks', 'model_checker': 'behaviours/model_checker'}

SKIPPED = re.compile(r'(^|/)(\.git|node_modules)/|(^|/)(CHANGELOG\.md|LICENSE|package-lock\.json|\.git-blame-ignore-revs)$'
                     r'|\.(png|svg|xsd|mcap|ico|gz|zst|pdf|woff2?)$')
CPP = {'.h', '.cpp', '.inc', '.c', '.cc', '.hpp'}
JS = {'.js', '.mjs', '.html', '.jsx'}
PY = {'.py', '.pyi'}
KEYWORDS = set('''alignas alignof and asm auto bool break case catch char class co_await co_return co_yield concept const
consteval constexpr constinit const_cast continue decltype default delete do double dynamic_cast else enum explicit export
extern false float for friend goto if inline int long mutable namespace new noexcept not nullptr operator or private protected
public register reinterpret_cast requires return short signed sizeof static static_assert static_cast struct switch template
this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t while xor
linux unix major minor makedev errno stdin stdout stderr assert EOF NULL ERROR INFINITY NAN TRUE FALSE None Bool Status Success
log exp sin cos time read write open close send recv bind connect accept listen signal abort exit remove rename index
'''.split())
C_FUNCTIONS = set('log exp sin cos time read write open close send recv bind connect accept listen signal abort exit remove '
                  'rename index'.split())  # lower case: only a free function or macro of that name would be trouble
TOKEN = re.compile(r'[A-Za-z_]\w*')


class Row(collections.namedtuple('Row', 'old new kind scope mode reason line')):
    @property
    def language(self):
        return {'js': 'js', 'python': 'py'}.get(self.kind, 'cpp')

    @property
    def is_sequence(self):
        return not re.fullmatch(r'[A-Za-z_]\w*\*?', self.old)


def read_map(path):
    rows = []
    for number, line in enumerate(open(path, encoding='utf8'), 1):
        line = line.rstrip('\n')
        if not line or line.startswith('#'):
            continue
        fields = line.split('\t')
        if len(fields) != 6:
            sys.exit(f'{path}:{number}: six fields, separated by tabs')
        rows.append(Row(*fields, number))
    return rows


# --- files -----------------------------------------------------------------------------------------------------------------

def list_files(root):
    listed = subprocess.run(['git', '-C', root, 'ls-files', '-z'], capture_output=True, text=True)
    if listed.returncode != 0:
        sys.exit(f'{root} is no git working tree: {listed.stderr.strip()}')
    return [f for f in listed.stdout.split('\0') if f and not SKIPPED.search(f) and not os.path.islink(os.path.join(root, f))
            and os.path.isfile(os.path.join(root, f))]


def ending(path):
    name = os.path.basename(path)
    if name == 'CMakeLists.txt' or name.endswith(('.cmake', '.cmake.in')) or name.startswith('CMakeLists.txt'):
        return '.cmake'
    if name.endswith('.in'):
        name = name[:-3]
    return os.path.splitext(name)[1]


def expand_braces(glob):
    found = re.search(r'\{([^{}]*)\}', glob)
    if not found:
        return [glob]
    return [each for part in found.group(1).split(',')
            for each in expand_braces(glob[:found.start()] + part + glob[found.end():])]


def split_scope(scope):
    parts, depth, part = [], 0, ''
    for c in scope:
        depth += (c == '{') - (c == '}')
        if c == ',' and depth == 0:
            parts.append(part)
            part = ''
        else:
            part += c
    return [p for p in parts + [part] if p]


class Scopes:
    """Which files a scope has."""

    def __init__(self, files):
        self.files = files
        self.folders = {os.path.dirname(f) for f in files}
        for folder in list(self.folders):
            while folder:
                folder = os.path.dirname(folder)
                self.folders.add(folder)
        self.cache = {}

    def district(self, name):
        """Of `@structure`: regular expressions of its folders and its tests."""
        moved = DISTRICTS.get(name)
        if moved and f'plugins/{moved}' in self.folders:
            places = [f'plugins/{moved}', f'tests/plugins/{moved}']
            if f'tests/plugins/{moved}' not in self.folders:
                places.append(f'tests/plugins/{name}')
            only = places
        else:
            only = [f'plugins/{name}', f'tests/plugins/{name}', f'core/{name}', f'tests/core/{name}', f'bench/plugins/{name}']
        return [re.compile(re.escape(place) + r'/.*') for place in only]

    def matcher(self, scope):
        if scope in self.cache:
            return self.cache[scope]
        patterns = []
        for part in split_scope(scope):
            if part.startswith('@'):
                patterns += self.district(part[1:])
                continue
            for glob in expand_braces(part):
                pattern = ''
                at = 0
                while at < len(glob):
                    if glob.startswith('**/', at):
                        pattern += '(?:.*/)?'
                        at += 3
                    elif glob.startswith('**', at):
                        pattern += '.*'
                        at += 2
                    elif glob[at] == '*':
                        pattern += '[^/]*'
                        at += 1
                    else:
                        pattern += re.escape(glob[at])
                        at += 1
                patterns.append(re.compile(pattern))
                # modules/planning, as apps and modules may have moved, too: at any depth.
                if not glob.startswith('**'):
                    patterns.append(re.compile('(?:.*/)?' + pattern))
        found = {f for f in self.files if any(p.fullmatch(f) for p in patterns)}
        self.cache[scope] = found
        return found


# --- text ------------------------------------------------------------------------------------------------------------------

CPP_PARTS = re.compile(r'R"(?P<d>[^()\s\\]{0,16})\(.*?\)(?P=d)"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"'
                       r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.S)
JS_PARTS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|' r"'(?:\\.|[^'\\\n])*'", re.S)
PY_PARTS = re.compile(r'"""(?:.*?)"""|' r"'''(?:.*?)'''" r'|#[^\n]*|"(?:\\.|[^"\\\n])*"|' r"'(?:\\.|[^'\\\n])*'", re.S)
CMAKE_PARTS = re.compile(r'#[^\n]*')


def segments(text, end):
    """(kind, text): code, comment, string, text."""
    if end == '.md':
        at = 0
        for fence in re.finditer(r'^```cpp\n(.*?)^```', text, re.S | re.M):
            yield 'text', text[at:fence.start(1)]
            yield from segments(fence.group(1), '.cpp')
            at = fence.end(1)
        yield 'text', text[at:]
        return
    parts = CPP_PARTS if end in CPP or end in ('.lua', '.gen', '.idl') else JS_PARTS if end in JS else \
        PY_PARTS if end in PY else CMAKE_PARTS if end == '.cmake' else None
    if parts is None:
        yield 'text', text
        return
    at = 0
    for found in parts.finditer(text):
        if found.start() > at:
            yield 'code', text[at:found.start()]
        piece = found.group()
        is_comment = piece.startswith(('//', '/*')) or (end in PY | {'.cmake'} and piece[0] == '#') or \
            piece.startswith(('"""', "'''"))
        yield 'comment' if is_comment else 'string', piece
        at = found.end()
    if at < len(text):
        yield 'code', text[at:]


def is_distinctive(token):
    """Whether it cannot be a word of prose: HandSlot, kMostEvents, hand_slot_; not Hear, kept."""
    return bool(re.search(r'[a-z0-9][A-Z]|_', token))


# --- the renaming ----------------------------------------------------------------------------------------------------------

class Renaming:
    def __init__(self, root, rows):
        self.root = root
        self.files = list_files(root)
        self.scopes = Scopes(self.files)
        self.texts = {}
        for file in self.files:
            try:
                self.texts[file] = open(os.path.join(root, file), encoding='utf8', newline='').read()
            except UnicodeDecodeError:
                pass
        self.files = list(self.texts)
        self.rows = [r for r in rows if r.mode == 'auto']
        self.explicit = [r for r in rows if r.kind != 'file']
        self.hits = collections.Counter()
        self.places = 0
        self.changed = {}
        self.errors = []
        self._all = {}
        self.own = {}
        self.by_language = {n: [r for r in self.rows if r.kind != 'file' and r.language == n] for n in ('cpp', 'js', 'py')}
        self.pieces = {}
        self.words = {f: set(TOKEN.findall(text)) for f, text in self.texts.items()}
        self.olds = {r.old for r in self.rows if not r.is_sequence and not r.old.endswith('*')}
        self.starts = tuple(r.old[:-1] for r in self.rows if r.old.endswith('*'))
        self.firsts = {TOKEN.search(r.old).group() for r in self.rows if r.is_sequence and TOKEN.search(r.old)}
        self.tokens = {f: self.code_tokens(f) for f in self.files}

    def has_some(self, file):
        words = self.words[file]
        return not words.isdisjoint(self.olds) or not words.isdisjoint(self.firsts) or \
            bool(self.starts) and any(w.startswith(self.starts) for w in words)

    def parts(self, file):
        if file not in self.pieces:
            self.pieces[file] = list(segments(self.texts[file], ending(file)))
        return self.pieces[file]

    def code_tokens(self, file):
        end = ending(file)
        if end not in CPP | JS | PY:
            return set()
        return {t for kind, piece in self.parts(file) if kind == 'code' for t in TOKEN.findall(piece)}

    def is_script(self, file):
        return '.' not in os.path.basename(file) and self.texts[file].startswith('#!')

    def language(self, file):
        end = ending(file)
        return 'cpp' if end in CPP else 'js' if end in JS else 'py' if end in PY else 'other'

    # Which new name each token has in a file; and the sequences.
    def names(self, file, language):
        key = (file, language)
        if key in self._all:
            return self._all[key]
        single, sequences, patterns = {}, [], []
        words = self.words[file]
        for row in self.by_language[language]:
            if not row.old.endswith('*') and not row.is_sequence and row.old not in words and row.new not in words:
                continue
            if file not in self.scopes.matcher(row.scope):
                continue
            if row.is_sequence:
                sequences.append(row)
            elif row.old.endswith('*'):
                patterns.append(row)
            else:
                known = single.get(row.old)
                if known is None or known.scope == '**':
                    single[row.old] = row
                elif row.scope != '**' and known.new != row.new:
                    self.errors.append(f'{file}: {row.old} becomes {known.new} and {row.new}')
        # What has a row of its own here, if only one for a person, does not go by a pattern.
        self.own[file] = {r.old for r in self.explicit if r.old in words and file in self.scopes.matcher(r.scope)} if patterns else set()
        self._all[key] = single, sequences, patterns
        return self._all[key]

    def find(self, token, single, patterns, file):
        row = single.get(token)
        if row is not None:
            return row, row.new
        if token in self.own.get(file, ()):
            return None, None
        for row in patterns:
            start = row.old[:-1]
            rest = token[len(start):]
            if token.startswith(start) and (rest == '' or rest[0].isupper()):
                return row, row.new[:-1] + rest
        return None, None

    def replaced(self, file, kind, piece, single, sequences, patterns, into_strings):
        is_script = self.is_script(file)
        if kind == 'code':
            for row in sequences:
                tokens = re.findall(r'[A-Za-z_]\w*|->|::|\S', row.old)
                pattern = r'\s*'.join(re.escape(t) for t in tokens)
                def put(found, row=row):
                    self.hits[row.line] += 1
                    self.places += 1
                    return row.new
                piece = re.sub(r'(?<![\w])' + pattern + r'(?!\w)', put, piece)

        def put(found):
            token = found.group()
            row, new = self.find(token, single, patterns, file)
            if row is None:
                return token
            before, after = piece[:found.start()], piece[found.end():]
            if kind == 'string' and token not in into_strings:
                # Only the names of types and functions: a file's name goes with the file, a key stays.
                if not re.search(r'[a-z0-9][A-Z]', token) or token[0].islower() and not token.startswith('k'):
                    return token
            if kind == 'comment' and not is_distinctive(token):
                if not (after.startswith('(') or before.endswith('::') or before.endswith('`') and after.startswith('`')):
                    return token
            if kind == 'text':
                paragraph = re.sub(r'^```.*$', '', before[before.rfind('\n\n') + 1:], flags=re.M)
                in_ticks = paragraph.count('`') % 2 == 1
                is_name = re.search(r'[a-z0-9][A-Z]', token) is not None  # which no word of prose is
                if not is_name and not (in_ticks and (is_distinctive(token) or after.startswith('('))) and \
                        not (is_script and is_distinctive(token)):
                    return token
                if re.match(r'\.(h|cpp|js|py)\b|_test|/', after) or before.endswith(('/', '-', '"', '=')):
                    return token
            self.hits[row.line] += 1
            self.places += 1
            return new
        return TOKEN.sub(put, piece)

    def apply_tokens(self):
        for file in self.files:
            end = ending(file)
            language = self.language(file)
            if language == 'other':
                if end not in ('.md',) and not self.is_script(file):
                    continue
                language = 'cpp'
            if not self.has_some(file):
                continue
            single, sequences, patterns = self.names(file, language)
            into_strings = set()
            if language == 'cpp' and end in CPP:
                in_strings = {**self.names(file, 'js')[0], **self.names(file, 'py')[0]}
                into_strings = set(in_strings)
            if not single and not sequences and not patterns and not into_strings:
                continue
            text = self.texts[file]
            result = []
            for kind, piece in self.parts(file):
                if kind == 'string' and re.match(r'"[\w./-]+\.(h|js|py|cpp)"$', piece):
                    result.append(piece)  # an include: the files' business
                elif kind == 'string' and into_strings:
                    result.append(self.replaced(file, kind, piece, in_strings, [], [], into_strings))
                    if in_strings:
                        result[-1] = self.replaced(file, kind, result[-1], single, [], patterns, set())
                else:
                    result.append(self.replaced(file, kind, piece, single, sequences, patterns, into_strings))
            new = ''.join(result)
            if new != text:
                self.changed[file] = new

    # --- collisions ---

    def check(self):
        taken = collections.defaultdict(set)  # token -> files whose code has it
        for file, tokens in self.tokens.items():
            for token in tokens:
                taken[token].add(file)
        allowed = read_allowed()
        made = collections.defaultdict(lambda: collections.defaultdict(set))  # file -> new -> olds
        for file in self.files:
            language = self.language(file)
            if language == 'other' or not self.has_some(file):
                continue
            single, sequences, patterns = self.names(file, language)
            for token in self.tokens[file]:
                row, new = self.find(token, single, patterns, file)
                if row is not None:
                    made[file][new].add((token, row))
        for file, names in made.items():
            language = self.language(file)
            single, _, patterns = self.names(file, language)
            for new, olds in names.items():
                tokens = sorted({t for t, _ in olds})
                row = next(iter(olds))[1]
                if new in KEYWORDS - (C_FUNCTIONS if row.kind == 'member' else set()):
                    self.errors.append(f'{file}: {tokens[0]} -> {new}: a keyword, a macro, or a function of C')
                if len(tokens) > 1 and (new, '') not in allowed and not any((new, t) in allowed for t in tokens):
                    self.errors.append(f'{file}: {" and ".join(tokens)} both become {new}')
                stays = lambda f: self.find(new, self.names(f, language)[0], self.names(f, language)[2], f)[0] is None
                if new in self.tokens[file] and stays(file) and not any((new, t) in allowed or (new, '') in allowed for t in tokens):
                    self.errors.append(f'{file}: {tokens[0]} -> {new}: there already')
                elif row.kind in ('class', 'function') and row.scope == '**' and row.kind == 'class':
                    others = [f for f in taken.get(new, ()) if self.language(f) == language and stays(f)]
                    if others and not any((new, t) in allowed or (new, '') in allowed for t in tokens):
                        self.errors.append(f'{tokens[0]} -> {new}: a name in {others[0]} (and {len(others) - 1} more)')
        # A name whose declaration is renamed and not each of its uses, or the reverse, is left to the compiler.

    # --- files ---

    def moves(self):
        moves = {}
        for row in self.rows:
            if row.kind != 'file':
                continue
            scope = self.scopes.matcher(row.scope)
            count = 0
            for file in self.files:
                folder, name = os.path.split(file)
                if file not in scope or not re.match(r'(core|plugins|modules|apps|tests|bench)/', file):
                    continue
                stem, dot, rest = name.partition('.')
                for suffix in ('', '_test', '_search_test', '_faults_test'):
                    if stem == row.old + suffix and rest in ('h', 'cpp', 'js', 'test.mjs', 'mjs', 'py', 'css', 'h.in', 'cpp.in'):
                        moves[file] = os.path.join(folder, row.new + suffix + dot + rest)
                        count += 1
            self.hits[row.line] += count
        targets = collections.Counter(moves.values())
        for old, new in moves.items():
            if targets[new] > 1:
                self.errors.append(f'{old} -> {new}: two files would be called so')
            if new in self.texts and new not in moves:
                self.errors.append(f'{old} -> {new}: there is such a file')
        return moves

    def apply_moves(self, moves):
        if not moves:
            return
        names = collections.Counter(os.path.basename(f) for f in self.files)
        full = {old: new for old, new in moves.items()}
        known = {os.path.splitext(old)[0]: os.path.splitext(new)[0] for old, new in moves.items()}
        known.update(full)
        paths = re.compile(r'(?<![\w/])(?:' + '|'.join(re.escape(p) for p in sorted(known, key=len, reverse=True)) + r')(?!\w)')
        ends = tuple({os.path.basename(old) for old in moves} | {os.path.splitext(os.path.basename(old))[0] for old in moves})
        for file in self.files:
            text = self.changed.get(file, self.texts[file])
            if not any(name in text for name in ends):
                continue
            before = text
            end = ending(file)
            folder = os.path.dirname(file)
            # "core/base/lookout.h", core/base/lookout_test and the like, wherever they stand.
            text = paths.sub(lambda found: known[found.group()], text)
            # As seen from the folder of the file that names it (CMakeLists, README, imports of JavaScript).
            def relative(found):
                name = found.group()
                seen = os.path.normpath(os.path.join(folder, name))
                if seen in full:
                    return name[:len(name) - len(os.path.basename(name))] + os.path.basename(full[seen])
                return name
            text = re.sub(r'(?<![\w/])[\w./-]+\.(?:h|cpp|js|mjs|py|css)\b', relative, text)
            # In prose: a name that only one file has.
            if end in ('.md',) or end in CPP | JS or self.is_script(file):
                for old, new in full.items():
                    base = os.path.basename(old)
                    if names[base] == 1 and base in text:
                        text = re.sub(r'(?<![\w/])((?:[\w.]+/)*)' + re.escape(base) + r'(?!\w)',
                                      lambda found: found.group(1) + os.path.basename(new), text)
            # In scripts also without its ending: the name of a test.
            if self.is_script(file):
                for old, new in full.items():
                    stem = os.path.splitext(os.path.basename(old))[0]
                    if '_' in stem:
                        text = re.sub(r'(?<![\w/])' + re.escape(stem) + r'(?![\w/])',
                                      os.path.splitext(os.path.basename(new))[0], text)
            # Modules of Python, as words.
            if end in PY:
                for old, new in full.items():
                    if old.endswith('.py'):
                        text = re.sub(r'\b' + re.escape(os.path.basename(old)[:-3]) + r'\b', os.path.basename(new)[:-3], text)
            if text != before:
                self.changed[file] = text
        for old in full:
            self.changed.setdefault(old, self.texts[old])

    def write(self, moves):
        for file, text in self.changed.items():
            if text != self.texts[file]:
                with open(os.path.join(self.root, file), 'w', encoding='utf8', newline='') as out:
                    out.write(text)
        for old, new in moves.items():
            os.makedirs(os.path.join(self.root, os.path.dirname(new)), exist_ok=True)
            subprocess.run(['git', '-C', self.root, 'mv', old, new], check=True)


def read_allowed():
    """Pairs of new and old that have been looked at: the new name exists in the file, of another class. allowed.tsv."""
    allowed = set()
    path = os.path.join(HERE, 'allowed.tsv')
    if os.path.exists(path):
        for line in open(path, encoding='utf8'):
            if line.strip() and not line.startswith('#'):
                new, old = (line.rstrip('\n').split('\t') + [''])[:2]
                allowed.add((new, old))
    return allowed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('root')
    parser.add_argument('--map', action='append', help='instead of map.tsv and map_local.tsv beside this script')
    parser.add_argument('--check', action='store_true', help='changes nothing')
    parser.add_argument('--format', action='store_true', help='runs clang-format on what was changed')
    parser.add_argument('--force', action='store_true', help='in spite of collisions')
    parser.add_argument('--unused', action='store_true', help='prints the rows that found nothing')
    arguments = parser.parse_args()
    rows = [row for path in arguments.map or [os.path.join(HERE, n) for n in ('map.tsv', 'map_local.tsv')]
            for row in read_map(path)]
    rows = [row._replace(line=n) for n, row in enumerate(rows)]  # each its own number
    renaming = Renaming(arguments.root, rows)
    renaming.check()
    renaming.apply_tokens()
    moves = renaming.moves()
    renaming.apply_moves(moves)
    changed = [f for f, text in renaming.changed.items() if text != renaming.texts[f]]
    unused = [r for r in renaming.rows if renaming.hits[r.line] == 0]
    print(f'{renaming.places} places in {len(changed)} files, {len(moves)} files renamed, by '
          f'{len(renaming.rows) - len(unused)} of {len(renaming.rows)} rows')
    if arguments.unused:
        for row in unused:
            print(f'nothing found: {row.old} -> {row.new} ({row.kind}, {row.scope})')
    for error in sorted(set(renaming.errors)):
        print('collision:', error)
    if renaming.errors and not arguments.force:
        print(f'{len(set(renaming.errors))} collisions: nothing has been changed')
        return 1
    if arguments.check:
        return 0
    renaming.write(moves)
    if arguments.format:
        cpp = [moves.get(f, f) for f in changed if ending(f) in CPP and not f.endswith('.in')]
        for at in range(0, len(cpp), 100):
            subprocess.run(['clang-format', '-i'] + cpp[at:at + 100], cwd=arguments.root, check=True)
        print(f'{len(cpp)} files formatted')
    return 0


if __name__ == '__main__':
    sys.exit(main())
