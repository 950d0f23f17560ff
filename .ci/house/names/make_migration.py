import json,re,collections,os
class R: pass
rows=[]
for n in('map.tsv','map_local.tsv'):
    for l in open(n):
        if l.startswith('#') or not l.strip(): continue
        rows.append(l.rstrip('\n').split('\t'))
pub=set(json.load(open('public_headers.json')))
tags=collections.defaultdict(list)
for l in open('tags.json'):
    t=json.loads(l)
    if t['path'] in pub: tags[t['name']].append(t)
files={r[0]:r[1] for r in rows if r[2]=='file'}
out=collections.defaultdict(list); seen=set()
HAND={'Port::Release':('Port','Release','ReleaseManualValue')}
def clean(s): return re.sub(r'__anon\w+(::)?|\brunnel::','',s)
def owner(o):
    m={r[0]:r[1] for r in rows if r[2]=='class' and r[4]=='auto'}
    return '::'.join(m.get(x,x) for x in o.split('::'))
import fnmatch
for old,new,kind,scope,mode,reason in rows:
    if kind not in('class','function','member') or not re.fullmatch(r'\w+',old) or mode!='auto': continue
    for t in tags.get(old,[]):
        sc=clean(t.get('scope',''))
        if 'internal' in sc or t.get('access') in('private','protected') and old not in('Miss',) : continue
        if t['kind'] in('local','parameter'): continue
        stem=os.path.splitext(os.path.basename(t['path']))[0]
        # scope must cover this header: by folder or stem
        ok=False
        for p in scope.split(','):
            p=p.strip()
            if p=='**': ok=True
            elif p.startswith('@'): ok|=f"/{p[1:]}/" in '/'+t['path']
            else:
                q=p.replace('**/','').replace('{','').replace('}','')
                base=q.split('/')[-1].split('.')[0].replace('*','')
                ok|= (base!='' and base==stem) or (q.endswith('**') and t['path'].startswith(q.rstrip('*'))) or (p.endswith('/**') and p[:-3].strip('*/') and p[:-3].strip('*/') in t['path'])
        if not ok: continue
        is_type=t['kind'] in('class','struct','enum','typedef')
        name=(sc+'::' if sc and t.get('scopeKind') in('class','struct','enum') else '')+old
        newname=(owner(sc)+'::' if sc and t.get('scopeKind') in('class','struct','enum') else '')+new
        if old==sc.split('::')[-1]: continue  # constructors
        if name in seen: continue
        seen.add(name)
        out[t['path']].append((name+('()' if t['kind'] in('function','prototype') else ''),newname+('()' if t['kind'] in('function','prototype') else '')))
with open('migration.md','w') as f:
    w=f.write
    w('''# From 0.2 to 0.3: names

Version 0.3.0 changes names once, without aliases. This page has the C++ and Python names that users of the installed headers and of the
package meet, and the words of files and of the terminal. Why a word was chosen: see the [glossary](glossary.md). Names of a project of
yours are changed by the same table: `rename.py` of Runnel's sources takes `--map FILE` (old, new, kind, scope, mode, reason; tabs).

In all of it: *by hand* became **manual value**, *distant* and *far* became **remote**, *told* and *said* became **reported**, **sent** or
**published**, *look* became **check**, **poll** or **update**, *note* became **record** or **mark**, *late* is only "one cycle late" now
and what waits for its ends is **pending**, *kept state* became **transferable state**, *watch* became **monitor** or **observer**,
*form* became **codec**, *misfit* and *trouble* became **mismatch** and **problem**, *offence* and *breach* became **violation**.

## Headers

`#include <runnel/…>` is as it was. Who includes single headers:

| old | new |
|---|---|
''')
    for p in sorted(pub):
        s=os.path.splitext(os.path.basename(p))[0]
        if s in files: w(f'| `{p}` | `{os.path.dirname(p)}/{files[s]}.h` |\n')
    w('\n## C++\n\n')
    n=0
    for p in sorted(out):
        s=os.path.splitext(os.path.basename(p))[0]
        w(f'### `{os.path.dirname(p)}/{files.get(s,s)}.h`\n\n| old | new |\n|---|---|\n')
        for a,b in sorted(set(out[p])):
            w(f'| `{a}` | `{b}` |\n'); n+=1
        w('\n')
    w('''By hand, as the same word stands for other things, too:

| old | new |
|---|---|
| `Port::Release(Setter)` | `Port::ReleaseManualValue(Setter)` |
| `Blackboard::Look()` | `Blackboard::Visit()` |
| `Service…::form()`, `Client…::form()` | `codec()` |
| `SchedulerOptions::watch` | `SchedulerOptions::observer` |

## Python

| old | new | until 0.4 |
|---|---|---|
| `activity.is_abort_asked` | `activity.is_abort_requested` | – |
| `Type.meaning` | `Type.semantic_tag` | `meaning` warns (`DeprecationWarning`) |
| `Recording.about` | `Recording.metadata` | `about` warns |
| `Series.frame()` | `Series.to_dataframe()` | `frame()` warns |

All other methods keep their names: they are the commands of the terminal.

## Files

| old | new | until 0.4 |
|---|---|---|
| `<module type="behaviours/planner_status_teller">` | `type="behaviours/planner_status_reporter"` | read, with a warning that has file, line and the new word; `runnel check --fix FILE` rewrites it |

All other words of XML, of panels and of configuration files stay: they are the field's words, or the glossary says what they mean.

## Terminal

The commands and their options stay. Help texts use the words of the glossary.

## Protocol of the page

| old | new |
|---|---|
| `misfit` (message `network`) | `mismatch` |

Texts that recordings have (`GateState`: `never_came`, `old`; `CallRecord`: `asked_to_end`) stay as they are, so that recordings of 0.2
can be read.
''')
    print(n)
