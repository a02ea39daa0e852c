brisance_test(base_test SOURCES unit/core/base/keys_test.cpp unit/core/base/units_test.cpp unit/core/base/errors_test.cpp
              LINKS brisance::base LABELS unit)
brisance_test(model_test SOURCES unit/core/model/row_sampler_test.cpp unit/core/model/simulation_test.cpp LINKS brisance::model LABELS unit)
