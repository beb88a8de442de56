"""How often limit states are reached at a site:  python3 risk.py fragility.h5 hazard.csv risk.html
A hazard may be a power law, too:                python3 risk.py fragility.h5 k0=1e-3,k=3,measure=pgv risk.html"""

import sys

import stylobate

found = stylobate.risk(sys.argv[1], sys.argv[2], years=[50, 100])
print(found.to_pandas()[["limit_state", "annual_frequency", "probability_50_years", "probability_50_years_lower",
                         "probability_50_years_upper"]])
found.write("risk.h5")
stylobate.report("risk.h5").write(sys.argv[3])
