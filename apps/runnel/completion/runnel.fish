# Completion for fish: commands, options, and what a running application has; files for what takes them.

function __runnel_candidates
    set -l words (commandline -opc) (commandline -ct)
    runnel complete --all $words[2..] 2>/dev/null
end

complete -c runnel -f -a '(__runnel_candidates)'
complete -c runnel -F -n '__fish_seen_subcommand_from run check graph replay save change info'
