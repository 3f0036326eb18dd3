# tmux.sh: a terminal of 80 by 24 cells with a shell, for tests of terminal output. Sourced after support.sh; $2 is
# `chafa` if petri can show pictures in terminals.

[ "${2:-chafa}" = chafa ] || skip "petri was built without libchafa (Debian: libchafa-dev)"
needs tmux tmux

work=$(mktemp -d) || exit 1
socket=petri-view-$$
mux() { tmux -L "$socket" -f /dev/null "$@"; }
trap 'mux kill-server 2>/dev/null; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cd "$work" || exit 1
unset DISPLAY WAYLAND_DISPLAY SDL_VIDEODRIVER TMUX NO_COLOR
LC_ALL=C.UTF-8
export LC_ALL

screen() { mux capture-pane -p -t view; }
print_details() { screen | sed 's/^/  | /'; }
type_keys() { mux send-keys -t view "$@"; }
shows() { screen | grep -Fq -e "$1"; }
hides() { ! shows "$1"; }
# part TOP BOTTOM LEFT RIGHT: prints the characters in these rows and columns (counted from 1) that are not blank.
# `filled` succeeds if there are any, `clear_of` if there are none.
part() { screen | sed -n "$1,$2p" | sed "s/^.\{0,$(($3 - 1))\}//" | cut_columns $(($4 - $3 + 1)) | tr -d ' \n'; }
cut_columns() { sed "s/^\(.\{0,$1\}\).*/\1/"; }
filled() { [ -n "$(part "$@")" ]; }
clear_of() { [ -z "$(part "$@")" ]; }

mux new-session -d -s view -x 80 -y 24 "PS1='ready: ' sh" || skip "tmux does not start"
soon shows 'ready:' || skip "no shell under tmux"

# Clears the screen, so that old output is not taken for that of the next command.
wipe() { mux send-keys -R -t view; }
# Succeeds if a picture is on the alternate screen. The normal screen may still show the command line.
started() { soon seen && soon filled 1 24 1 80; }
seen() { mux display-message -p -t view '#{alternate_on}#{cursor_flag}' | grep -q 10; }
