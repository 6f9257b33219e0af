; The heart of a visit: go to a person, and greet them. Read this first; visit.pddl, which states all that is planned, adds
; agendas, groups, priorities and full hands. A plan for this domain is one for that, at the same cost.
(define (domain core-domain)
  (:requirements :strips :typing :negative-preconditions :action-costs)
  (:types
    robot place side modality gesture - object
    user - place)                      ; the robot stands on one of a person's sides

  (:predicates
    (at ?r - robot ?p - place ?s - side)
    (docked ?r - robot ?p - place)     ; near enough to a person, and turned to them, to greet
    (free ?r - robot)                  ; owes nobody a greeting, so it may leave
    (greeted ?u - user)
    (reachable ?u - user ?s - side)    ; the person accepts this side, and some route leads there
    (permitted ?u - user ?m - modality ?g - gesture)
    (route ?origin - place ?origin_side - side ?u - user ?s - side))

  (:functions                          ; centimetres of walking, or what is worth as much
    (travel_cost ?origin - place ?origin_side - side ?u - user ?s - side)
    (greet_cost ?u - user ?m - modality ?g - gesture)
    (total-cost))

  (:action Reach_user                  ; binds the distance, the direction and the speed
    :parameters (?r - robot ?u - user ?s - side ?origin - place ?origin_side - side)
    :precondition (and (free ?r) (at ?r ?origin ?origin_side) (not (greeted ?u))
      (reachable ?u ?s) (route ?origin ?origin_side ?u ?s))
    :effect (and (at ?r ?u ?s) (docked ?r ?u) (not (at ?r ?origin ?origin_side)) (not (docked ?r ?origin))
      (not (free ?r)) (increase (total-cost) (travel_cost ?origin ?origin_side ?u ?s))))

  (:action Greet_person                ; binds the words, the gesture, or both
    :parameters (?r - robot ?u - user ?m - modality ?g - gesture)
    :precondition (and (docked ?r ?u) (not (greeted ?u)) (permitted ?u ?m ?g))
    :effect (and (greeted ?u) (free ?r) (increase (total-cost) (greet_cost ?u ?m ?g)))))
