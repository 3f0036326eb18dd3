autocmd BufNewFile,BufRead *.fl setfiletype flitter
