#!/usr/bin/env bash
# What action.yml runs: `install` puts regscribe into an environment of its own, `ask` asks all questions and fails at the end.
# Whatever a caller of the action chooses comes in variables; nothing of it becomes part of a script, an option or a command
# of the runner. (`${x[@]+"${x[@]}"}`: the bash of macOS takes an empty array for an unset variable.)
set -euo pipefail

ENVIRONMENT=$RUNNER_TEMP/regscribe

refuse() {
    printf '::error title=regscribe::%s\n' "$1"
    exit 2
}

check_switch() { # check_switch INPUT VALUE
    [[ $2 == true || $2 == false ]] || refuse "$1: write true or false"
}

install() {
    local -a wanted=("$GITHUB_ACTION_PATH/generator/runtime" "$GITHUB_ACTION_PATH/generated" "$GITHUB_ACTION_PATH")
    if [[ -n $VERSION ]]; then
        [[ $VERSION =~ ^[0-9][0-9A-Za-z.+!]*$ ]] || refuse "version: write a version of regscribe as 0.1.0"
        wanted=("regscribe==$VERSION")
    fi
    "$PYTHON" -m venv "$ENVIRONMENT"
    "$ENVIRONMENT/bin/python" -m pip install --quiet --disable-pip-version-check "${wanted[@]}"
}

# Print what a command prints, none of which the runner takes for a command of its own; note the worst exit code.
quoted() { # quoted TITLE COMMAND...
    local code=0 token
    token=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
    printf '::group::%s\n::stop-commands::%s\n' "$1" "$token"
    "${@:2}" || code=$?
    printf '::%s::\n::endgroup::\n' "$token"
    note "$code" "$1"
}

note() { # note CODE TITLE
    if (($1 > 0)); then failed+=("$2 (exit code $1)"); fi
    if (($1 > worst)); then worst=$1; fi
}

# Findings stand beside lines and in SARIF by their paths in the repository, so the maps are named from there.
check() {
    local code=0 sarif_code=0
    local -a options=()
    if [[ $STRICT == true ]]; then options+=(--strict); fi
    regscribe check ${options[@]+"${options[@]}"} --format github -- "${from_root[@]}" || code=$?
    note "$code" "check"
    [[ -n $SARIF_FILE ]] || return 0
    mkdir -p -- "$(dirname -- "$SARIF_FILE")"
    regscribe check --format sarif -- "${from_root[@]}" >"$SARIF_FILE" || sarif_code=$?
    if ((sarif_code < 2)); then printf 'sarif-file=%s\n' "$SARIF_FILE" >>"$GITHUB_OUTPUT"; fi
}

compare_generated() {
    cd -- "$WORKING_DIRECTORY"
    regscribe generate --check -- ${named[@]+"${named[@]}"}
}

tell_breaking() {
    cd -- "$WORKING_DIRECTORY"
    regscribe breaking --against="$BREAKING_AGAINST" --format markdown -- ${named[@]+"${named[@]}"} | tee -a "$GITHUB_STEP_SUMMARY"
}

ask() {
    local worst=0 path prefix=""
    local -a named=() from_root=() failed=()
    check_switch strict "$STRICT"
    check_switch check-generated "$CHECK_GENERATED"
    [[ -d $WORKING_DIRECTORY ]] || refuse "working-directory: there is no such folder"
    [[ $SARIF_FILE != *$'\n'* ]] || refuse "sarif-file: write a path of one line"
    if [[ $WORKING_DIRECTORY != . ]]; then prefix=${WORKING_DIRECTORY%/}/; fi
    while IFS= read -r path; do
        [[ -n $path ]] || continue
        named+=("$path")
        if [[ -e $WORKING_DIRECTORY/$path ]]; then from_root+=("$prefix$path"); else from_root+=("$path"); fi
    done <<<"$MAPS"
    if ((${#named[@]} == 0)); then from_root=("${prefix}maps"); fi
    if [[ -d $ENVIRONMENT/bin ]]; then PATH=$ENVIRONMENT/bin:$PATH; fi

    check
    if [[ $CHECK_GENERATED == true ]]; then quoted "generate --check" compare_generated; fi
    if [[ -n $BREAKING_AGAINST ]]; then quoted "breaking" tell_breaking; fi
    ((worst == 0)) || printf '::error title=regscribe::failed: %s\n' "$(IFS=,; printf '%s' "${failed[*]}")"
    exit "$worst"
}

case "${1:-}" in
    install | ask) "$1" ;;
    *) refuse "action.sh takes install or ask" ;;
esac
