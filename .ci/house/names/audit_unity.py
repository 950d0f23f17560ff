import json,re,os,collections,sys
sys.argv=['x']; import rename as R
rows=[r for n in('map.tsv','map_local.tsv') for r in R.read_map(n) if r.mode=='auto' and r.kind in('class','function','member')]
tags=[json.loads(l) for l in open('tags.json')]
sc=R.Scopes(sorted({t['path'] for t in tags}|set(R.list_files('try'))))
M=collections.defaultdict(list)
for r in rows:
    if not r.is_sequence and not r.old.endswith('*'): M[r.old].append((r.scope,sc.matcher(r.scope),r.new))
pats=[(r.old[:-1],r.new[:-1]) for r in rows if r.old.endswith('*')]
expl={r.old for r in rows}
def new(name,path):
    c=[(s,n) for s,S,n in M.get(name,()) if path in S]
    if c:
        c.sort(key=lambda x:x[0]=='**'); return c[0][1]
    if name in expl: return name
    for a,b in pats:
        rest=name[len(a):]
        if name.startswith(a) and (rest=='' or rest[0].isupper()): return b+rest
    return name
def target(p):
    q=p.split('/')
    return '/'.join(q[:2])
free=collections.defaultdict(lambda: collections.defaultdict(set)) # target -> newname -> {(file,old)}
head=collections.defaultdict(set)
for t in tags:
    s=t.get('scope','')
    if t.get('scopeKind') in('class','struct','enum','function'): continue
    if t['kind'] not in('function','variable','class','struct','enum','typedef','prototype','enumerator'): continue
    if t['name'].startswith('__anon') or t['name'].startswith('operator'): continue
    ns=re.sub(r'__anon\w+','',s)
    n=new(t['name'],t['path'])
    if t['path'].endswith('.cpp'):
        if '__anon' in s or t['kind']!='function': free[target(t['path'])][n].add((t['path'],t['name']))
    else: head[n].add((t['path'],t['name'],ns.strip(':')))
for tg in sorted(free):
    for n,v in sorted(free[tg].items()):
        files={f for f,_ in v}
        if len(files)>1 and any(o!=n for _,o in v):
            # were they duplicates before?
            olds=collections.Counter(o for _,o in v)
            if len(olds)==1: continue
            print('UNITY',tg,n,sorted((os.path.basename(f),o) for f,o in v))
        if any(o!=n for _,o in v) and n in head:
            print('HEADER',tg,n,sorted((os.path.basename(f),o) for f,o in v)[:2],[(os.path.basename(a),b,c) for a,b,c in head[n]][:3])
for n,v in sorted(head.items()):
    olds={o for _,o,_ in v}
    if len(olds)>1 and any(o!=n for o in olds):
        print('HEADERS',n,sorted((os.path.basename(p),o,c) for p,o,c in v)[:5])
