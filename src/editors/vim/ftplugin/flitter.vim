" Filetype plugin for Flitter scripts (petri).
if exists('b:did_ftplugin')
    finish
endif
let b:did_ftplugin = 1
setlocal expandtab shiftwidth=4 softtabstop=4 commentstring=--\ %s comments=:-- suffixesadd=.fl
setlocal include=^\\s*\\%(import\\\|%include\\)\\>.*['\"]\\zs[^'\"]*
" :make lists diagnostics; gq formats the script.
setlocal makeprg=petri\ check\ --format=gcc\ %:S errorformat=%f:%l:%c:\ %t%*[^:]:\ %m,%-Gpetri:%.%#
setlocal formatprg=petri\ fmt\ -
let b:undo_ftplugin = 'setlocal expandtab< shiftwidth< softtabstop< commentstring< comments< suffixesadd< include<'
            \ . ' makeprg< errorformat< formatprg<'
