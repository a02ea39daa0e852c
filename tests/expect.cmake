# brisance_expect(name CODE n MESSAGE regex [ABSENT path] [RANKS n] [LABELS ...] COMMAND ...): the command ends with this exit
# code, says this, and leaves no such path; with RANKS under mpirun.
function(brisance_expect name)
  cmake_parse_arguments(PARSE_ARGV 1 E "" "CODE;MESSAGE;ABSENT;RANKS" "COMMAND;LABELS")
  if(NOT E_ABSENT)
    set(E_ABSENT -)
  endif()
  set(launch "")
  if(E_RANKS)
    set(launch ${MPIEXEC} --allow-run-as-root --oversubscribe --mca mpi_yield_when_idle 1 -n ${E_RANKS})
  endif()
  add_test(NAME ${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/support/expect_exit.sh ${E_CODE} "${E_MESSAGE}" ${E_ABSENT}
                                ${launch} ${E_COMMAND})
  set_tests_properties(${name} PROPERTIES LABELS "${E_LABELS}" TIMEOUT 300)
endfunction()
