// What a shell runs when a user asks it to complete a line that begins with glissade. The program itself knows what
// may follow: the scripts hand it the words and offer what it answers, files excepted.

#include "app/completion.hpp"

namespace glissade::app {
namespace {

constexpr const char* kBash = R"script(# bash completion for glissade; made by 'glissade completion bash'.
_glissade() {
  local current=${COMP_WORDS[COMP_CWORD]} word rest ending path glued=
  local -a words=()
  # Bash breaks words at = and :, the program does not.
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ -n $glued || $word == [=:]* ]] && ((${#words[@]})); then
      words[${#words[@]} - 1]+=$word
    else
      words+=("$word")
    fi
    glued=
    [[ $word == [=:]* ]] && glued=yes
  done
  ((${#words[@]})) || words=("")
  [[ $current == [=:]* ]] && current=
  local whole=${words[${#words[@]} - 1]}
  local before=${whole%"$current"}
  COMPREPLY=()
  while IFS=$'\t' read -r word rest; do
    case $word in
      :files)
        compopt -o filenames 2>/dev/null
        for ending in ${rest:-""}; do
          while IFS= read -r path; do COMPREPLY+=("$path"); done < <(compgen -f -X "!*$ending" -- "$current")
        done
        [[ -n $rest ]] || while IFS= read -r path; do COMPREPLY+=("$path"); done < <(compgen -f -- "$current")
        [[ -z $rest ]] || while IFS= read -r path; do COMPREPLY+=("$path"); done < <(compgen -d -- "$current")
        ;;
      :directories)
        compopt -o filenames 2>/dev/null
        while IFS= read -r path; do COMPREPLY+=("$path"); done < <(compgen -d -- "$current")
        ;;
      *)
        [[ $word == *= ]] && compopt -o nospace 2>/dev/null
        COMPREPLY+=("${word#"$before"}")
        ;;
    esac
  done < <("$1" __complete "${words[@]}" 2>/dev/null)
}
complete -F _glissade glissade
)script";

constexpr const char* kZsh = R"script(#compdef glissade
# zsh completion for glissade; made by 'glissade completion zsh'.
_glissade() {
  local line name meaning
  local -a closed open
  while IFS= read -r line; do
    name=${line%%$'\t'*}
    meaning=
    [[ $line == *$'\t'* ]] && meaning=${line#*$'\t'}
    case $name in
      :files)
        [[ $PREFIX == --*=* ]] && compset -P '*='
        if [[ -n $meaning ]]; then
          _files -g "*(${(j:|:)${=meaning}})(-.)"
        else
          _files
        fi
        ;;
      :directories)
        [[ $PREFIX == --*=* ]] && compset -P '*='
        _files -/
        ;;
      *=) open+=("${name//:/\\:}${meaning:+:$meaning}") ;;
      *) closed+=("${name//:/\\:}${meaning:+:$meaning}") ;;
    esac
  done < <("${words[1]}" __complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)
  ((${#open})) && _describe -t values value open -S ''
  ((${#closed})) && _describe -t values value closed
}
# Read by a shell, or found by it in its function path.
if [[ ${funcstack[1]} == _glissade ]]; then
  _glissade "$@"
else
  compdef _glissade glissade
fi
)script";

constexpr const char* kFish = R"script(# fish completion for glissade; made by 'glissade completion fish'.
function __glissade_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l program $words[1]
    set -e words[1]
    # What stands before the = of an option is no part of a path.
    set -l before (string match -r -- '^--[^=]*=' $current)
    set -l begun (string replace -r -- '^--[^=]*=' '' $current)
    for line in ($program __complete $words $current 2>/dev/null)
        set -l parts (string split -m 1 \t -- $line)
        switch $parts[1]
            case :files
                for path in $begun*
                    if test -d $path
                        echo "$before$path/"
                    else if not set -q parts[2]
                        echo "$before$path"
                    else
                        for ending in (string split ' ' -- $parts[2])
                            string match -q -- "*$ending" $path; and echo "$before$path"
                        end
                    end
                end
            case :directories
                for path in $begun*/
                    echo "$before$path"
                end
            case '*'
                echo $line
        end
    end
end
complete -c glissade -f -a '(__glissade_complete)'
)script";

}  // namespace

const std::vector<std::string>& completed_shells() {
  static const std::vector<std::string> kShells = {"bash", "zsh", "fish"};
  return kShells;
}

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return kBash;
  if (shell == "zsh") return kZsh;
  return shell == "fish" ? kFish : "";
}

}  // namespace glissade::app
