#!/usr/bin/env bash
# expect_exit.sh CODE REGEX ABSENT COMMAND...: the command ends with CODE and what it says, on one line, matches REGEX (of
# grep -E), with at most one error message; with ABSENT not "-", that path does not exist afterwards, though it may before:
# it is removed first.
set -u
code=$1 regex=$2 absent=$3
shift 3
[[ $absent == - ]] || rm -rf "$absent"
said=$("$@" 2>&1)
got=$?
failed=0
if [[ $got -ne $code ]]; then
  echo "FAILED: exit code $got, expected $code"
  failed=1
fi
if ! tr '\n' ' ' <<<"$said" | grep -qE -- "$regex"; then
  echo "FAILED: the message does not match: $regex"
  failed=1
fi
if [[ $(grep -c 'brisance: error' <<<"$said") -gt 1 ]]; then
  echo "FAILED: more than one error message"
  failed=1
fi
if [[ $absent != - && -e $absent ]]; then
  echo "FAILED: $absent was written"
  failed=1
fi
printf 'command: %s\nexit code: %s\n%s\n' "$*" "$got" "$said"
exit $failed
