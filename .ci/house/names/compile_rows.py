#!/usr/bin/env python3
"""rows/*.txt -> map.tsv"""
import glob,re,sys
K={'c':'class','f':'function','m':'member','F':'file','l':'folder-local file','x':'xml word','t':'cli word','p':'python','j':'js'}
rows=[];section='';seen={}
for fn in sorted(glob.glob('rows/*.txt')):
    scope='**';reason=''
    for n,l in enumerate(open(fn),1):
        l=l.strip()
        if not l or l.startswith('#'):
            continue
        m=re.match(r'\[scope=(.*?); reason=(.*)\]$',l)
        if m: scope,reason=m.group(1),m.group(2);continue
        parts=[p.strip() for p in l.split(' ; ')]
        if parts[0].endswith(' ;'): parts[0]=parts[0][:-2]
        if len(parts)==1 and ';' in l: parts=[p.strip() for p in l.split(';')]
        a,b=[x.strip() for x in parts[0].split(' > ')]
        kind=None;mode='auto';sc=None;rs=None
        for p in parts[1:]:
            if not p: continue
            if p in K and kind is None: kind=K[p]
            elif p=='hand': mode='hand'
            elif sc is None and re.match(r'^(\*\*|@\w|[\w*]+/|\*\*/)[^ ]*(,[^ ]+)*$',p): sc=p
            elif p=='doubtful': rs=(rs+'; ' if rs else '')+'doubtful'; 
            else: rs=(rs+'; ' if rs else '')+p
        if kind is None: print('no kind',fn,n,l);continue
        sc=(sc or scope).rstrip(',').replace('@modules_behaviours','modules/behaviours/**')
        rs=rs or reason
        key=(a,sc,kind)
        if key in seen: print('dup',key)
        seen[key]=1
        rows.append((a,b,kind,sc,mode,rs))
import pickle,os,sys,collections
sys.argv=['x']; import rename as R
idx=pickle.load(open('idx.pkl','rb'))['code']
sc=R.Scopes(sorted({p for v in idx.values() for p in v}))
def is_local(r):
    """Seen by one source file only: a name of a .cpp, or a private member or constant of one header and its .cpp."""
    if r[4]!='auto' or r[2] not in('function','member','class') or r[0].endswith('*') or not re.fullmatch(r'\w+',r[0]): return False
    S=sc.matcher(r[3])
    fs=[f for f in idx.get(r[0],{}) if f in S]
    if not fs: return False
    if not any(f.endswith('.h') for f in fs): return True
    stems={os.path.splitext(os.path.basename(f))[0] for f in fs}
    return len(stems)==1 and (r[0].endswith('_') or re.match(r'k[A-Z]',r[0]) is not None)
def write(name,what,rs):
    with open(name,'w') as f:
        f.write(what+'# old\tnew\tkind\tscope\tmode\treason\n')
        for r in rs: f.write('\t'.join(r)+'\n')
local=[r for r in rows if is_local(r)]
write('map.tsv','',[r for r in rows if r not in local])
write('map_local.tsv','# Names that one source file sees: the same columns as map.tsv.\n',local)
print(len(rows),len(local),collections.Counter(r[4] for r in rows),collections.Counter(r[2] for r in rows))
