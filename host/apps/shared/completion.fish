# Completion of @program@ for fish, which asks the program itself.
function __@program@_words
    set -l words (commandline -opc)
    set -l cur (commandline -ct)
    for word in ($words[1] complete $words[2..] "$cur" 2>/dev/null)
        if test "$word" = /
            __fish_complete_path "$cur"
        else
            echo $word
        end
    end
end
complete -c @program@ -f -a '(__@program@_words)'
