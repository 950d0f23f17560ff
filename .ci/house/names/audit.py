"""audit map.tsv against try/: ambiguity (several owners in scope), leftovers outside scope, described members, new names declared elsewhere"""
import sys,json,collections,re,os
sys.argv=['x']; import rename as R
rows=R.read_map('map.tsv')
files=R.list_files('try')
sc=R.Scopes(files)
import pickle
idx=pickle.load(open('idx.pkl','rb'))['code']
tags=[json.loads(l) for l in open('tags.json')]
by=collections.defaultdict(list)
for t in tags: by[t['name']].append(t)
def owner(t):
    s=t.get('scope','')
    s=re.sub(r'__anon\w+(::)?|runnel::|\(anonymous namespace\)::','',s)
    return s if t.get('scopeKind') in('class','struct','enum') else ''
# described
desc=set()
for f in files:
    if f.endswith(('.h','.cpp')):
        x=open('try/'+f,encoding='utf8').read()
        for m in re.finditer(r'\.?(?:Fields|Values)<([^>;]*)>',x):
            desc|=set(re.findall(r'::(\w+)',m.group(1)))
mode=os.environ.get('M','all')
def short(p):
    q=p.split('/'); return '/'.join(q[-2:]) if q[0]!='tests' else 't/'+q[-1]
for r in rows:
    if r.mode!='auto' or r.kind in('file','js','python','xml word') or r.is_sequence or r.old.endswith('*'): continue
    S=sc.matcher(r.scope)
    # other rows with same old
    others=set()
    for q in rows:
        if q.old==r.old and q is not r and q.mode=='auto': others|=sc.matcher(q.scope)
    occ={f:n for f,n in idx.get(r.old,{}).items() if f.endswith(('.h','.cpp','.in','.c','.inc'))}
    ins={f:n for f,n in occ.items() if f in S}
    out={f:n for f,n in occ.items() if f not in S and f not in others}
    ow=collections.defaultdict(set)
    for t in by[r.old]:
        if t['path'] in S: ow[(owner(t),t['kind'][0])].add(os.path.basename(t['path']))
    ows={o for o,k in ow}
    msg=[]
    if not ins: msg.append('NO-HIT')
    if len(ows)>1: msg.append('OWNERS '+'; '.join(f"{o or '(free)'}:{k}@{','.join(sorted(v)[:2])}" for (o,k),v in sorted(ow.items())))
    if out:
        msg.append(f'OUT {sum(out.values())}/{sum(ins.values())}in: '+' '.join(f'{short(f)}={n}' for f,n in sorted(out.items(),key=lambda x:-x[1])[:7])+(' …' if len(out)>7 else ''))
    if r.old in desc: msg.append('DESCRIBED')
    nd=[t for t in by.get(r.new,[])]
    if nd:
        fr=sorted({owner(t)+'@'+os.path.basename(t['path']) for t in nd if (owner(t)=='' and t['kind'] in('function','prototype','class','struct','enum','typedef','macro','variable')) })
        same=sorted({owner(t) for t in nd if owner(t) and owner(t) in ows})
        if same: msg.append('SAMECLASS '+','.join(same))
        if fr and r.kind in('class','function'): msg.append('NEWFREE '+' '.join(fr[:4]))
    if msg: print(f"{r.line} {r.old}>{r.new} [{r.kind[0]} {r.scope[:60]}] "+' | '.join(msg))
