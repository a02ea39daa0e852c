# What lives below all physics: Comm, exact sums, digests, partitions, archives.
brisance_test(parallel_values SOURCES unit/parallel/exact_sum_test.cpp unit/parallel/digest_test.cpp
              LINKS brisance::parallel LABELS unit)
brisance_test(parallel_comm SOURCES parallel/comm_test.cpp LINKS brisance::parallel RANKS 1 2 3 4 LABELS parallel)
brisance_test(parallel_partition SOURCES parallel/partition_test.cpp LINKS brisance::parallel RANKS 1 4 LABELS parallel)
brisance_test(parallel_archive SOURCES parallel/archive_test.cpp LINKS brisance::parallel RANKS 1 2 3 4 LABELS parallel)
