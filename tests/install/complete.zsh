# complete.zsh FOLDER: completes some command lines with the script in FOLDER, and prints the results one per line.
zmodload zsh/zpty
zpty terminal zsh -f -i
zpty -w terminal "PS1=; fpath=($1:q \$fpath); autoload -Uz compinit; compinit -u -D; unsetopt list_ambiguous auto_menu"
# The Enter key prints the line instead of executing it.
zpty -w terminal 'give-back() { print -r -- "<$BUFFER>"; BUFFER=; zle accept-line }; zle -N give-back; bindkey "^M" give-back; bindkey "^J" give-back'
for words in 'petri ren' 'petri run --traj' 'petri run --neighbours=n' 'petri one.fl --traj' 'petri help electros' \
    'petri run --print tree,h' 'petri run one.fl -D DR' 'petri run on' 'petri run --allow-read=fo' 'petri run --state tw'; do
    zpty -w -n terminal $words$'\t\r'
    zpty -r -m terminal output '*<petri*>*' && print -r -- ${${output##*<}%%>*}
done
zpty -d terminal
