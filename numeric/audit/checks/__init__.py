"""What is asked of an implementation: generators of checks, one file a topic, and the catalogue of all of them.

identification                   models, from records without fault and with a coloured one
faults, excitation               residuals, ranks, the number of faults, their space and signal, also where data cannot tell
structure                        zeros and ranks of a system
refusals, manners, growth        what must be refused; the same answer twice; memory and time by the length of the record
catalogue                        every check that there is, and the choice among them
"""
