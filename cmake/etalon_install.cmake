# find_package(etalon CONFIG) for outside projects; proved by tests/install.
