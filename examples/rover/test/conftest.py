pytest_plugins = ['amr_description.testing.fixtures']
