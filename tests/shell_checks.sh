# What the scripts that try the built program check with; each sources it and ends with `exit` by $failures.
failures=0

fail() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }
same() { [ "$2" = "$3" ] || fail "$1: expected '$2', got '$3'"; }
contains() { case $3 in *"$2"*) ;; *) fail "$1: '$2' is not in '$3'" ;; esac; }

# run EXIT ARGUMENTS...: runs $awan and expects that exit code; output in `out`, messages in `err`, in this folder.
run() {
    local expected=$1
    shift
    "$awan" "$@" >out 2>err
    same "exit code of awan $*" "$expected" "$?"
}
